//! What an agent does in one step.

/// Most bodies that one body is kept apart from in a step; more do not fit around it.
const MOST_CONTACTS: usize = 16;
/// Farthest that a body is moved in a step, metres; walls beyond that need not be looked up.
pub(super) const MOST_MOVED_M: f32 = 0.6;

/// Move of an agent in one step, before bodies and walls correct it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Move {
    /// Where the velocity leads, metres.
    pub(super) x: f32,
    pub(super) y: f32,
    /// Bodies that may come to overlap with this one, as indices into the neighbours' grid.
    pub(super) contacts: [u32; MOST_CONTACTS],
    pub(super) contact_count: u32,
    /// Least distance of this body's middle from walls here, metres.
    pub(super) wall_limit_m: f32,
    /// Whether neither bodies nor walls correct this move.
    pub(super) fixed: bool,
}

impl Move {
    /// Notes a body that may come to overlap with this one.
    #[inline]
    pub(super) fn touch(&mut self, other: u32) {
        if let Some(contact) = self.contacts.get_mut(self.contact_count as usize) {
            *contact = other;
            self.contact_count += 1;
        }
    }
}
