//! Ordinary plans of any size and scale end in reasonable time, with walls that do not cross.
