use std::io;

use super::place::Place;

/// A file in the making.
pub(super) trait Sheet: Send {
    fn frame(&mut self, number: u64, places: &[Place]) -> io::Result<()>;

    /// Writes what is left; gives the number of bytes written if it was counted.
    fn close(self: Box<Self>) -> io::Result<u64>;
}
