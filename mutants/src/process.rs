//! One test in a process of its own.

use std::fs;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

#[derive(Clone, Serialize, Deserialize)]
pub struct Test {
    pub program: String,
    /// The file of the program.
    pub path: String,
    pub name: String,
    /// Seconds of CPU time without a fault.
    pub seconds: f64,
    /// Faults whose switch was asked.
    pub reached: Vec<u32>,
}

impl Test {
    pub fn full_name(&self) -> String {
        format!("{}::{}", self.program, self.name)
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    Passed,
    Failed,
    TimedOut,
}

const TICKS: f64 = 100.0;

/// CPU time of a process, of those of its children that have ended, too.
fn seconds(process: &str, fields: &[usize]) -> f64 {
    let text = fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    let after = text.rsplit_once(')').map_or("", |(_, after)| after);
    let field = |at: &usize| after.split_whitespace().nth(at - 3).and_then(|field| field.parse::<f64>().ok());
    fields.iter().filter_map(field).sum::<f64>() / TICKS
}

/// How long all threads of a process may wait, in seconds; a test of the command line waits for other processes.
const IDLE: f64 = 5.0;

/// Whether some thread of a process runs, or would if it got a processor.
fn is_running(process: &str) -> bool {
    let tasks = fs::read_dir(format!("/proc/{process}/task")).into_iter().flatten().filter_map(Result::ok);
    let mut states = tasks.filter_map(|task| fs::read_to_string(task.path().join("stat")).ok());
    states.any(|text| text.rsplit_once(')').is_some_and(|(_, after)| !after.starts_with(" S")))
}

/// Runs a test; `limit` is in seconds of CPU time.
pub fn run(copy: &Path, test: &Test, switch: (&str, &str), limit: f64) -> (Ended, f64) {
    let before = seconds("self", &[16, 17]);
    // Others may work on this machine.
    let mut command = Command::new("nice");
    command.args(["-n", "19"]).arg(&test.path).arg("--exact").args(test.name.split(' '));
    command.current_dir(copy).env(switch.0, switch.1).env("CARGO_MANIFEST_DIR", copy);
    command.env("RUST_BACKTRACE", "0").env("INSTA_UPDATE", "no").env_remove("PETRIL_BLESS").env_remove("TRYCMD");
    // Each run of a test tries the same inputs, and a failure is not made smaller.
    command.env("PROPTEST_RNG_SEED", "1").env("PROPTEST_MAX_SHRINK_ITERS", "0");
    command.env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "true");
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).process_group(0);
    let mut child = command.spawn().unwrap_or_else(|error| panic!("{}: {error}", test.path));
    let (mut pause, group) = (Duration::from_micros(500), child.id().to_string());
    let idle = if test.name.starts_with("cli::") { 10.0 * IDLE } else { IDLE };
    let mut waited = Duration::ZERO;
    let ended = loop {
        if let Some(status) = child.try_wait().expect("a child can be waited for") {
            break if status.success() { Ended::Passed } else { Ended::Failed };
        }
        if seconds(&group, &[14, 15, 16, 17]) > limit || waited.as_secs_f64() > idle {
            let _ = Command::new("kill").args(["-KILL", "--", &format!("-{group}")]).status();
            let _ = child.wait();
            break Ended::TimedOut;
        }
        let asleep = Instant::now();
        sleep(pause);
        waited += if is_running(&group) { Duration::ZERO } else { asleep.elapsed() };
        pause = (pause * 2).min(Duration::from_millis(20));
    };
    (ended, seconds("self", &[16, 17]) - before)
}
