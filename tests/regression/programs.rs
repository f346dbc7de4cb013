//! What is written opens right in the programs that read it.
