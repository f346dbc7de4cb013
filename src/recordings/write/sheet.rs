use std::io;

use super::place::RecordedPlace;

/// A file in the making.
pub(super) trait MotionSink: Send {
    fn frame(&mut self, number: u64, places: &[RecordedPlace]) -> io::Result<()>;

    /// Writes what is left; gives the number of bytes written if it was counted.
    fn close(self: Box<Self>) -> io::Result<u64>;
}
