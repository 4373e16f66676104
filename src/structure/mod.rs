//! What can be said of a net without exploring it: the theory of its structure.

pub mod reduce;
