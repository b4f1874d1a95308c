//! A clock that counts instructions, on machines whose time is instructions (`-icount`).
//!
//! On Arm's MPS2 boards it is the first CMSDK timer, at 25 MHz (20 MHz on the AN505); with
//! `-icount shift=7` an instruction takes 128 ns, so it ticks 3.2 (2.56) times an instruction. A difference
//! of two readings is off by less than a tick, so the nearest whole number of instructions is exact.
//! RISC-V counts retired instructions itself.

/// Starts the clock.
#[cfg(target_arch = "arm")]
pub fn start() {
    // SAFETY: the timer's registers, which nothing else uses; see `TIMER`.
    unsafe {
        TIMER.wrapping_add(RELOAD).write_volatile(u32::MAX);
        TIMER.wrapping_add(VALUE).write_volatile(u32::MAX);
        TIMER.wrapping_add(CONTROL).write_volatile(1);
    }
}

/// Ticks, wrapping.
#[cfg(target_arch = "arm")]
#[inline(always)]
pub fn now() -> u32 {
    // The timer counts down.
    // SAFETY: a read of the timer's value, without effects.
    !unsafe { TIMER.wrapping_add(VALUE).read_volatile() }
}

/// CMSDK TIMER0 (Arm DDI 0479, APB timer): words at CTRL 0x0, VALUE 0x4, RELOAD 0x8. On the AN505 by its secure alias,
/// since the machine starts in secure state.
#[cfg(target_arch = "arm")]
const TIMER: *mut u32 =
    if cfg!(armv8m) { 0x5000_0000 as *mut u32 } else { 0x4000_0000 as *mut u32 };

#[cfg(target_arch = "arm")]
const CONTROL: usize = 0;
#[cfg(target_arch = "arm")]
const VALUE: usize = 1;
#[cfg(target_arch = "arm")]
const RELOAD: usize = 2;

/// Starts the clock.
#[cfg(target_arch = "riscv32")]
pub fn start() {}

/// Instructions, wrapping.
#[cfg(target_arch = "riscv32")]
#[inline(always)]
pub fn now() -> u32 {
    let instructions: u32;
    // SAFETY: a read of a counter, without effects.
    unsafe { core::arch::asm!("csrr {}, minstret", out(reg) instructions) };
    instructions
}

/// How much of it some work takes; it wraps.
pub fn ticks(work: impl FnOnce()) -> u32 {
    let start = now();
    work();
    now().wrapping_sub(start)
}

/// Runs `2 * pairs` instructions, and a few around them: what a clock is checked with.
#[inline(never)]
pub fn spin(pairs: u32) {
    // SAFETY: a loop over a register.
    #[cfg(target_arch = "arm")]
    unsafe {
        core::arch::asm!("2: subs {0}, {0}, #1", "bne 2b", inout(reg) pairs => _);
    }
    // SAFETY: a loop over a register.
    #[cfg(target_arch = "riscv32")]
    unsafe {
        core::arch::asm!("2: addi {0}, {0}, -1", "bnez {0}, 2b", inout(reg) pairs => _);
    }
}

/// Ticks of [`spin`]. Not inlined: it is the same for any number of pairs.
#[inline(never)]
pub fn ticks_of_spin(pairs: u32) -> u32 {
    ticks(|| spin(pairs))
}

/// Starts the clock, and prints two spins: their difference is 200,000 instructions, whatever the clock. Gives the ticks of two
/// reads with nothing between.
#[cfg(feature = "report")]
pub fn start_with_spins() -> u32 {
    start();
    let overhead = ticks(|| {});
    for pairs in [1_000, 101_000] {
        semihosting::println!("spin {pairs} {}", ticks_of_spin(pairs).wrapping_sub(overhead));
    }
    overhead
}
