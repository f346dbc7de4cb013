//! Numbers, counts and sizes that are absurd are refused with a message, never believed.
