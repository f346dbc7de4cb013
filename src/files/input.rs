//! Input files. Only regular files are opened, and only up to a stated size.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// Largest text file, bytes: a scenario, a look, a list of times or points, the YAML of a map.
pub const LARGEST_TEXT_BYTES: u64 = 64 << 20;
/// Largest image file, bytes: 2^28 pixels of four bytes, and its header.
pub const LARGEST_IMAGE_BYTES: u64 = (1 << 30) + (1 << 20);

/// Opens a regular file. Refuses pipes and devices, which may block or never end.
///
/// # Errors
/// There is no such file, it is not a regular file, or the system refuses.
pub fn open_input(path: &Path) -> io::Result<File> {
    let kind = fs::metadata(path)?.file_type();
    // Reading a folder gives the system's own error.
    if !(kind.is_file() || kind.is_dir()) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is a pipe or a device, not a regular file"));
    }
    File::open(path)
}

/// Opens a regular file of at most `most` bytes.
///
/// # Errors
/// The same as for [`open_input`]; the file is larger.
pub fn open_input_up_to(path: &Path, most: u64) -> io::Result<File> {
    let file = open_input(path)?;
    check_size(file.metadata()?.len(), most)?;
    Ok(file)
}

/// Reads a regular file of at most `most` bytes.
///
/// # Errors
/// The same as for `open_input_up_to`; the file cannot be read or does not fit in memory.
pub fn read_input(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // Checked again: some system files report no length.
    open_input_up_to(path, most)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    check_size(bytes.len() as u64, most)?;
    Ok(bytes)
}

/// Reads a regular file of at most [`LARGEST_TEXT_BYTES`] as UTF-8.
///
/// # Errors
/// The same as for [`read_input`]; the file is not UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    let bytes = read_input(path, LARGEST_TEXT_BYTES)?;
    String::from_utf8(bytes).map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text"))
}

fn check_size(bytes: u64, most: u64) -> io::Result<()> {
    if bytes <= most {
        return Ok(());
    }
    Err(io::Error::new(io::ErrorKind::FileTooLarge, format!("it has {bytes} bytes, allowed are {most}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "twelve bytes").unwrap();
        assert_eq!(read_input(&path, 12).unwrap(), b"twelve bytes");
        let error = read_input(&path, 11).unwrap_err();
        assert_eq!(error.to_string(), "it has 12 bytes, allowed are 11");
        assert_eq!(read_text(&path).unwrap(), "twelve bytes");
        fs::write(&path, [0xff, 0xfe]).unwrap();
        assert_eq!(read_text(&path).unwrap_err().kind(), io::ErrorKind::InvalidData);
        assert!(read_input(folder.path(), 11 << 20).is_err());
        assert_eq!(read_input(&folder.path().join("no"), 1).unwrap_err().kind(), io::ErrorKind::NotFound);
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_refused() {
        let error = read_input(Path::new("/dev/zero"), 10).unwrap_err();
        assert_eq!(error.to_string(), "it is a pipe or a device, not a regular file");
    }
}
