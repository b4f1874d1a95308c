//! The OLED boards on QEMU. Ignored by default: they need a cross toolchain and QEMU, and build
//! firmware. `cargo test --release -p host-tests --test oled -- --ignored --nocapture` prints what a
//! frame takes, and leaves pictures of the panels in the target folder.

use hither_examples::picture::target_folder;
use host_tests::boards::oled::BOARDS;

#[test]
#[ignore = "builds firmware and needs QEMU"]
fn panels_show_what_the_host_draws() {
    for board in BOARDS {
        let capture = board.check().unwrap_or_else(|why| panic!("{}: {why}", board.name));
        let costs = capture.costs().expect("checked");
        let mean = |part: fn(&_) -> u64| costs.iter().map(part).sum::<u64>() / costs.len() as u64;
        println!(
            "{}: {} instructions to draw a frame, {} to send it; {} bytes of RAM untouched; {:.1} s",
            board.name,
            mean(|cost| cost.draw),
            mean(|cost| cost.send),
            capture.untouched,
            capture.took.as_secs_f64(),
        );
        let path = target_folder().join(board.name).with_extension("png");
        capture.screen.write_png(&path, 4).expect("the target folder is writable");
    }
}

#[test]
#[ignore = "builds firmware and needs QEMU"]
fn a_flush_that_is_cut_short_is_noticed() {
    for board in BOARDS {
        let difference = board.check_fault().unwrap_or_else(|why| panic!("{}: {why}", board.name));
        println!("{}, with the fault: {difference}", board.name);
    }
}
