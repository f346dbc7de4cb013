//! Signals that end the program: Ctrl-C, a closed terminal, the end of a session.

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

    /// Number of the last caught signal, or 0.
    static CAUGHT: LazyLock<Arc<AtomicUsize>> = LazyLock::new(Arc::default);

    /// Installs the handlers: the first signal stops the work, the second ends the program.
    pub fn listen() {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            let again = Arc::new(AtomicBool::new(false));
            for signal in [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|&signal| !is_ignored(signal)) {
                // In this order: the first signal finds `again` unset. If registering fails, a signal ends the program
                // at once, which is acceptable.
                let _ = flag::register_conditional_default(signal, Arc::clone(&again));
                let _ = flag::register(signal, Arc::clone(&again));
                let _ = flag::register_usize(signal, Arc::clone(&CAUGHT), signal.unsigned_abs() as usize);
            }
        });
    }

    /// Whether a signal was caught.
    pub fn caught() -> bool {
        CAUGHT.load(Ordering::Relaxed) != 0
    }

    /// Ends the program by the caught signal, if any, so that a shell's loop ends too.
    pub fn end() {
        if let Ok(signal @ 1..) = i32::try_from(CAUGHT.load(Ordering::Relaxed)) {
            let _ = low_level::emulate_default_handler(signal);
        }
    }

    /// Turns writing beyond the file size limit into an error instead of the end of the program.
    pub fn survive_size_limit() {
        let _ = flag::register(SIGXFSZ, Arc::default());
    }

    /// Whether the program was started with SIGHUP ignored, as by `nohup`. It then stays ignored.
    fn is_ignored(signal: i32) -> bool {
        if signal != SIGHUP {
            return false;
        }
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        match ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()) {
            Some(mask) => mask >> (signal - 1) & 1 == 1,
            // Other systems do not report it; `nohup` detaches from the terminal.
            None => !io::stderr().is_terminal(),
        }
    }
}

#[cfg(not(unix))]
mod other {
    use std::sync::atomic::{AtomicBool, Ordering};

    static CAUGHT: AtomicBool = AtomicBool::new(false);

    /// Installs the handler: the first Ctrl-C stops the work, the second ends the program at once.
    pub fn listen() {
        // If this fails, Ctrl-C ends the program at once, which is acceptable.
        let _ = ctrlc::set_handler(|| {
            if CAUGHT.swap(true, Ordering::SeqCst) {
                std::process::exit(1);
            }
        });
    }

    /// Whether Ctrl-C was pressed.
    pub fn caught() -> bool {
        CAUGHT.load(Ordering::Relaxed)
    }

    /// Does nothing: this system has no exit by signal.
    pub fn end() {}

    /// Does nothing: this system has no such limit.
    pub fn survive_size_limit() {}
}
