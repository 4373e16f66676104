//! The real program, run in a folder and never for long.

use std::env;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// Signs what is known from earlier runs: tests make no key of their own in anybody's home.
pub const KEY: &str = "the key of all tests";

/// Nothing a test asks for may take longer.
const PATIENCE: Duration = Duration::from_secs(60);

/// What a run left.
#[derive(Debug)]
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

/// The program that cargo built beside the tests.
pub fn program() -> PathBuf {
    let test = env::current_exe().expect("a test knows its own file");
    let folder = test.ancestors().nth(2).expect("tests are in `deps`");
    folder.join("petril").with_extension(env::consts::EXE_EXTENSION)
}

/// Runs `petril` in a folder. A run that takes too long, or dies of a signal, fails the test.
pub fn petril<S: AsRef<str>>(folder: &Path, arguments: &[S]) -> Run {
    let mut command = Command::new(program());
    command.args(arguments.iter().map(AsRef::as_ref)).current_dir(folder).env("PETRIL_CACHE_KEY", KEY);
    run(command)
}

/// Runs a command.
pub fn run(mut command: Command) -> Run {
    command.env_remove("COLUMNS").env_remove("NO_COLOR").env_remove("PETRIL_CACHE").env("RUST_BACKTRACE", "0");
    // However busy the machine is, standard error has only what the test asks for.
    if command.get_envs().all(|(name, _)| name != "PETRIL_PROGRESS") {
        command.env("PETRIL_PROGRESS", "0");
    }
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program can be started");
    let (stdout, stderr) = (child.stdout.take().map(listen), child.stderr.take().map(listen));
    let started = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("the program can be waited for") {
            break status;
        }
        if started.elapsed() > PATIENCE {
            child.kill().expect("the program can be stopped");
            panic!("{command:?} takes more than {PATIENCE:?}");
        }
        thread::sleep(Duration::from_millis(2));
    };
    let text = |output: Option<thread::JoinHandle<Vec<u8>>>| {
        let bytes = output.map(|thread| thread.join().expect("output can be read")).unwrap_or_default();
        String::from_utf8(bytes).expect("output is UTF-8")
    };
    let (stdout, stderr) = (text(stdout), text(stderr));
    let code = status.code().unwrap_or_else(|| panic!("{command:?} died: {status}\n{stderr}"));
    // Neither is hidden by an exit code.
    for failed in ["panicked", "overflowed its stack"] {
        assert!(!stderr.contains(failed), "{command:?}\n{stderr}");
    }
    Run { code, stdout, stderr }
}

fn listen(mut output: impl Read + Send + 'static) -> thread::JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        output.read_to_end(&mut bytes).expect("output can be read");
        bytes
    })
}
