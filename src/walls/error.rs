/// Why the `walls` stage cannot go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WallsError {}

impl WallsError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        None
    }
}
