/// How much a bake will write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Estimate {
    /// Floor tiles.
    pub tiles: u64,
    /// Wall sheets, about.
    pub sheets: u64,
    /// Largest side of a texture, texels.
    pub tile_px: u32,
    /// Bytes of all files, about.
    pub bytes: u64,
}

impl Estimate {
    /// The numbers in words.
    pub(super) fn describe(&self, free: Option<u64>) -> String {
        let Estimate { tiles, sheets, tile_px, bytes } = *self;
        let free = free.map_or(String::new(), |free| format!("; {} are free", size(free)));
        format!("{tiles} floor tiles and {sheets} wall sheets of up to {tile_px} px, about {}{free}", size(bytes))
    }
}

/// A number of bytes with a unit.
pub(super) fn size(bytes: u64) -> String {
    match bytes {
        0..10_000_000_000 => format!("{:.1} GB", bytes as f64 / 1e9),
        _ => format!("{:.0} GB", bytes as f64 / 1e9),
    }
}
