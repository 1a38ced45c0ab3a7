//! The command-line tool.

use signorini::cli::{self, Stdout};
use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main(stdout())
}

#[cfg(unix)]
fn stdout() -> Stdout {
    before_main::stdout()
}

/// Elsewhere a write to a stdout that is closed fails by itself.
#[cfg(not(unix))]
fn stdout() -> Stdout {
    Stdout::Open
}

/// Where stdout is closed, as by `>&-`, Rust's runtime opens /dev/null in its place before `main`,
/// and every write to it succeeds. So it is looked at earlier, among the constructors of the
/// process.
#[cfg(unix)]
mod before_main {
    use signorini::cli::Stdout;
    use std::sync::atomic::{AtomicBool, Ordering};

    static CLOSED: AtomicBool = AtomicBool::new(false);

    // Nothing of the standard library that needs its runtime: a system call, and an atomic store.
    #[ctor::ctor(unsafe)]
    fn note_closed_stdout() {
        CLOSED.store(rustix::io::fcntl_getfd(rustix::stdio::stdout()).is_err(), Ordering::Relaxed);
    }

    pub fn stdout() -> Stdout {
        if CLOSED.load(Ordering::Relaxed) { Stdout::Closed } else { Stdout::Open }
    }
}
