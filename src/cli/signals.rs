//! Signals that ask the program to end: Ctrl-C, a closed terminal, the end of a session.

#[cfg(unix)]
pub use unix::{caught, end, listen, survive_size_limit};

#[cfg(not(unix))]
pub use other::{caught, end, listen, survive_size_limit};

#[cfg(unix)]
mod unix {
    use std::io::{self, IsTerminal};
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
    use std::sync::{Arc, LazyLock, Once};

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::{flag, low_level};

    /// The signal that was caught last, or 0.
    static CAUGHT: LazyLock<Arc<AtomicUsize>> = LazyLock::new(Arc::default);

    /// From now on the first signal asks the work to stop, and the second ends the program at once.
    pub fn listen() {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            let again = Arc::new(AtomicBool::new(false));
            for signal in [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|&signal| !is_ignored(signal)) {
                // In this order: the first signal finds `again` unset. Where there is no handler, a signal ends the
                // program at once, so nothing is lost if this fails.
                let _ = flag::register_conditional_default(signal, Arc::clone(&again));
                let _ = flag::register(signal, Arc::clone(&again));
                let _ = flag::register_usize(signal, Arc::clone(&CAUGHT), signal.unsigned_abs() as usize);
            }
        });
    }

    /// Whether a signal has asked the work to stop.
    pub fn caught() -> bool {
        CAUGHT.load(Ordering::Relaxed) != 0
    }

    /// Ends the program by the signal that was caught, if there is one, so that a shell's loop ends with it.
    pub fn end() {
        if let Ok(signal @ 1..) = i32::try_from(CAUGHT.load(Ordering::Relaxed)) {
            let _ = low_level::emulate_default_handler(signal);
        }
    }

    /// A file that grows beyond the limit of its size is an error of the write, not the end of the program.
    pub fn survive_size_limit() {
        let _ = flag::register(SIGXFSZ, Arc::default());
    }

    /// Whether the program was started with a closed terminal's signal ignored, as `nohup` does. It stays ignored then.
    fn is_ignored(signal: i32) -> bool {
        if signal != SIGHUP {
            return false;
        }
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        match ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()) {
            Some(mask) => mask >> (signal - 1) & 1 == 1,
            // Other systems do not tell; `nohup` takes the terminal away.
            None => !io::stderr().is_terminal(),
        }
    }
}

#[cfg(not(unix))]
mod other {
    use std::sync::atomic::{AtomicBool, Ordering};

    static CAUGHT: AtomicBool = AtomicBool::new(false);

    /// From now on the first Ctrl-C asks the work to stop, and the second ends the program at once.
    pub fn listen() {
        // Where there is no handler, Ctrl-C ends the program at once, so nothing is lost if this fails.
        let _ = ctrlc::set_handler(|| {
            if CAUGHT.swap(true, Ordering::SeqCst) {
                std::process::exit(1);
            }
        });
    }

    /// Whether Ctrl-C has asked the work to stop.
    pub fn caught() -> bool {
        CAUGHT.load(Ordering::Relaxed)
    }

    /// The exit code says it all on this system.
    pub fn end() {}

    /// There is no such limit on this system.
    pub fn survive_size_limit() {}
}
