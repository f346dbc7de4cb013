//! Reads a bake that another process may replace at the same time.

use std::path::Path;
use std::thread;
use std::time::Duration;

use same_file::Handle;

use super::places::restore;
use crate::export::ExportError;

/// Largest number of attempts to read.
const TRIES: u32 = 20;
const PAUSE: Duration = Duration::from_millis(25);

/// Reads bakes consistently: `read` sees all of the earlier bake or all of the later one.
///
/// A bake may be replaced during the read: then `read` is called again, at most 20 times in all.
///
/// # Errors
/// Those of `read`; a bake that a killed run moved aside cannot be restored.
pub fn settled<T, E: From<ExportError>>(bakes: &[&Path], read: impl Fn() -> Result<T, E>) -> Result<T, E> {
    let folders = || -> Vec<Option<Handle>> { bakes.iter().map(|bake| Handle::from_path(bake).ok()).collect() };
    let mut tries = 1;
    loop {
        for bake in bakes {
            match restore(bake) {
                // A path such as `..` can be read, but nothing lies beside it.
                Ok(_) | Err(ExportError::OutputHasNoName { .. }) => {}
                Err(error) => return Err(error.into()),
            }
        }
        // The handles are open files: as long as they live, no other folder can be taken for these.
        let before = folders();
        let result = read();
        if tries == TRIES || before == folders() {
            return result;
        }
        tries += 1;
        thread::sleep(PAUSE);
    }
}
