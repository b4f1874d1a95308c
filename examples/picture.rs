//! Pictures and animations on disk: PNG and APNG, 8-bit RGB.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// Where the build's output goes, and pictures with it: `CARGO_TARGET_DIR`, or `target` in the workspace.
#[must_use]
pub fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("target"),
        PathBuf::from,
    )
}

/// Writes an 8-bit RGB picture as PNG, and the folders above it where they are missing.
///
/// `rgb` has three bytes for each pixel, row after row from the top.
///
/// # Errors
///
/// [`io::ErrorKind::InvalidInput`] when a side is 0 or `rgb` is not `3 * width * height` bytes (the message has both
/// numbers); else what the file system says, with the path.
pub fn write_png(path: impl AsRef<Path>, width: u32, height: u32, rgb: &[u8]) -> io::Result<()> {
    write(path.as_ref(), [width, height], &[rgb], None)
}

/// Writes an animation of 8-bit RGB frames as APNG that plays forever, and the folders above it where they are missing.
///
/// Each frame has three bytes for each pixel, row after row from the top, and is shown for `frame_millis`
/// milliseconds. A viewer that knows no APNG shows the first frame.
///
/// # Errors
///
/// [`io::ErrorKind::InvalidInput`] when there is no frame, a side is 0, or a frame is not `3 * width * height` bytes
/// (the message has the frame and both numbers); else what the file system says, with the path.
pub fn write_apng(
    path: impl AsRef<Path>,
    width: u32,
    height: u32,
    frames: &[Vec<u8>],
    frame_millis: u16,
) -> io::Result<()> {
    let frames: Vec<&[u8]> = frames.iter().map(Vec::as_slice).collect();
    write(path.as_ref(), [width, height], &frames, Some(frame_millis))
}

/// Checks and writes frames: as an animation when there are milliseconds per frame, else the only one.
fn write(
    path: &Path,
    size: [u32; 2],
    frames: &[&[u8]],
    frame_millis: Option<u16>,
) -> io::Result<()> {
    check(size, frames)
        .and_then(|()| encode(path, size, frames, frame_millis))
        .map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", path.display())))
}

/// Whether a PNG of this size can hold these frames.
fn check([width, height]: [u32; 2], frames: &[&[u8]]) -> io::Result<()> {
    let invalid = |message: String| Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    if width == 0 || height == 0 {
        return invalid(format!("a picture of {width} x {height} has no pixel"));
    }
    if frames.is_empty() {
        return invalid("an animation needs a frame".to_owned());
    }
    // As u128 nothing overflows, however large the sides.
    let expected = 3 * u128::from(width) * u128::from(height);
    for (number, frame) in frames.iter().enumerate() {
        let got = frame.len();
        if got as u128 != expected {
            return invalid(format!(
                "{width} x {height} pixels take {expected} bytes, frame {number} has {got}"
            ));
        }
    }
    Ok(())
}

fn encode(
    path: &Path,
    [width, height]: [u32; 2],
    frames: &[&[u8]],
    frame_millis: Option<u16>,
) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    if let Some(millis) = frame_millis {
        let count = u32::try_from(frames.len()).map_err(io::Error::other)?;
        // 0 plays is forever.
        encoder.set_animated(count, 0)?;
        encoder.set_frame_delay(millis, 1000)?;
    }
    let mut writer = encoder.write_header()?;
    for frame in frames {
        writer.write_image_data(frame)?;
    }
    // Writes the end of the PNG; what the buffer keeps goes out, with any error, before the file is closed.
    writer.finish()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::BufReader;

    /// A path that no other test uses, in a folder that does not exist yet.
    fn fresh(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("hither-picture-{}", std::process::id())).join(name);
        let _ = fs::remove_dir_all(&folder);
        folder.join("deep").join("picture.png")
    }

    #[derive(Debug, PartialEq)]
    struct Read {
        size: [u32; 2],
        /// Of the first frame, as a fraction of a second; none for a still picture.
        delay: Option<(u16, u16)>,
        frames: Vec<Vec<u8>>,
    }

    fn read(path: &Path) -> Read {
        let file = BufReader::new(File::open(path).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        assert_eq!(reader.output_color_type(), (png::ColorType::Rgb, png::BitDepth::Eight));
        let info = reader.info();
        let size = [info.width, info.height];
        let count = info.animation_control.map_or(1, |a| a.num_frames);
        let delay = info.frame_control.map(|f| (f.delay_num, f.delay_den));
        let frames = (0..count)
            .map(|_| {
                let mut frame = vec![0; reader.output_buffer_size().unwrap()];
                reader.next_frame(&mut frame).unwrap();
                frame
            })
            .collect();
        Read { size, delay, frames }
    }

    fn pattern(length: usize, seed: usize) -> Vec<u8> {
        (0..length).map(|i| ((i * 37 + seed * 91) % 251) as u8).collect()
    }

    #[test]
    fn a_png_reads_back() {
        let path = fresh("png");
        let rgb = pattern(3 * 7 * 5, 1);
        write_png(&path, 7, 5, &rgb).unwrap();
        let expected = Read { size: [7, 5], delay: None, frames: vec![rgb] };
        assert_eq!(read(&path), expected);
    }

    #[test]
    fn an_apng_reads_back() {
        let path = fresh("apng");
        let frames: Vec<_> = (0..3).map(|seed| pattern(3 * 4 * 6, seed)).collect();
        write_apng(&path, 4, 6, &frames, 40).unwrap();
        let expected = Read { size: [4, 6], delay: Some((40, 1000)), frames };
        assert_eq!(read(&path), expected);
    }

    #[test]
    fn a_wrong_length_is_an_error_with_both_numbers() {
        let path = fresh("length");
        let frames = [vec![0; 12], vec![0; 11]];
        let error = write_apng(&path, 2, 2, &frames, 40).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
        let message = error.to_string();
        assert!(message.ends_with("2 x 2 pixels take 12 bytes, frame 1 has 11"), "{message}");
        assert!(!path.exists());
        assert!(write_png(&path, u32::MAX, u32::MAX, &[]).is_err());
    }

    #[test]
    fn nothing_to_write_is_an_error() {
        let path = fresh("nothing");
        for error in [
            write_png(&path, 0, 5, &[]).unwrap_err(),
            write_apng(&path, 2, 2, &[], 40).unwrap_err(),
        ] {
            assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
        }
    }

    #[test]
    fn a_path_that_cannot_be_made_is_named() {
        let path = fresh("blocked");
        write_png(&path, 1, 1, &[1, 2, 3]).unwrap();
        let below = path.join("file.png");
        let message = write_png(&below, 1, 1, &[1, 2, 3]).unwrap_err().to_string();
        assert!(message.contains("file.png"), "{message}");
    }
}
