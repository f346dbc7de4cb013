//! Files of the user are never lost, and results appear whole or not at all.
