/// What a texture covers: the first part of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::export) enum Covered {
    Floor,
    Wall,
}

impl Covered {
    /// Which of a block's masks a mask image holds, as red, green and blue.
    pub(in crate::export) fn packed_masks(self) -> [usize; 3] {
        match self {
            Covered::Floor => [0, 2, 3],
            Covered::Wall => [0, 1, 2],
        }
    }

    /// The mask that has an image of its own: the one that is needed least often.
    pub(in crate::export) fn lone_mask(self) -> usize {
        match self {
            Covered::Floor => 1,
            Covered::Wall => 3,
        }
    }

    /// What the image of that mask is called.
    pub(in crate::export) fn lone_mask_name(self) -> &'static str {
        match self {
            Covered::Floor => "passes",
            Covered::Wall => "splash",
        }
    }
}
