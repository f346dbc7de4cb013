use crate::look::{Background, FloorResolver, LAYERS, ResolvedBlock};

/// What gives a floor's texels: pure, so that any thread may ask for any rectangle in any order.
pub trait FloorSource: Sync {
    /// Names of the layers that blocks have, in the blocks' order.
    fn layers(&self) -> &[&'static str];

    /// What all texels of an empty block show.
    fn background(&self) -> Background;

    /// Resolves a rectangle of `width` x `height` texels with the lower-left texel (i0, j0) of the whole floor, also
    /// beyond the floor's edges.
    fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock;
}

impl FloorSource for FloorResolver<'_> {
    fn layers(&self) -> &[&'static str] {
        &LAYERS
    }

    fn background(&self) -> Background {
        FloorResolver::background(self)
    }

    fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        FloorResolver::resolve(self, i0, j0, width, height)
    }
}
