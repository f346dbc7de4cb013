use std::io;

use super::place::RecordedPlace;

/// A trajectory file that is being written.
pub(super) trait MotionSink: Send {
    fn frame(&mut self, number: u64, places: &[RecordedPlace]) -> io::Result<()>;

    /// Writes the rest; returns the number of bytes written, if counted.
    fn close(self: Box<Self>) -> io::Result<u64>;
}
