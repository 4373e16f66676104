//! The tables of docs/performance.md: `cargo bench --bench figures`, and `cargo bench --bench figures -- largest` (or `sizes`);
//! `cargo bench --bench figures -- program 2 7` prints one of the programs.
//!
//! Times are the shortest of several runs; runs that are compared take turns.

mod programs;

use std::time::{Duration, Instant};

use petril::explore::{Budget, Graph, Markings, ScanSpace, explore};
use petril::flat::flatten;
use petril::semantics;
use petril::source::Source;
use petril::syntax;
use petril::translate::{Plant, System};
use programs::{filters, mixed, numbers, system};
use rayon::ThreadPoolBuilder;

/// Runs of each measurement.
const RUNS: usize = 7;

fn main() {
    let asked = |word: &str| std::env::args().any(|argument| argument == word);
    // Without `--bench` this is a run of the tests, which has nothing to measure.
    match (asked("--bench"), asked("largest")) {
        (false, _) => {}
        (true, _) if asked("program") => print_program(),
        (true, true) => scan_view(&[(3, 7)], 1),
        (true, false) if asked("sizes") => program_sizes(),
        (true, false) => {
            program_sizes();
            scan_view(&[(1, 9), (2, 5), (3, 4), (3, 5), (2, 9), (3, 6)], RUNS);
            both_views();
            threads();
        }
    }
}

/// Prints the program of `program n m`, or of `program n`, for other tools.
fn print_program() {
    let sizes: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    match *sizes.as_slice() {
        [inputs, scans] => print!("{}", filters(inputs, scans)),
        [instructions] => print!("{}", mixed(instructions)),
        _ => println!("after `program`, there are one or two sizes"),
    }
}

/// Prints a table as Markdown has it.
fn table(heads: &[&str], rows: impl Iterator<Item = Vec<String>>) {
    println!("\n| {} |", heads.join(" | "));
    println!("|{}", "--:|".repeat(heads.len()));
    rows.for_each(|row| println!("| {} |", row.join(" | ")));
}

/// The shortest time of some runs of each task, and what that run returned.
fn shortest<T, const N: usize>(runs: usize, mut tasks: [&mut dyn FnMut() -> T; N]) -> [(Duration, T); N] {
    let mut timed = |task: usize| {
        let start = Instant::now();
        let result = tasks[task]();
        (start.elapsed(), result)
    };
    let mut best: [(Duration, T); N] = std::array::from_fn(&mut timed);
    for _ in 1..runs {
        for (task, best) in best.iter_mut().enumerate() {
            let run = timed(task);
            if run.0 < best.0 {
                *best = run;
            }
        }
    }
    best
}

/// Programs from 10 to 10,000 instructions, read and translated.
fn program_sizes() {
    let heads = ["instructions", "lines", "places", "transitions", "read, µs", "translate, µs", "ns per instruction"];
    let rows = [10, 30, 100, 300, 1000, 3000, 10_000]
        .into_iter()
        .map(|instructions| program_size(instructions.to_string(), instructions, &mixed(instructions)));
    table(&heads, rows);
    let heads = ["type", "lines", "places", "transitions", "read, µs", "translate, µs", "ns per instruction"];
    let sizes = ["SINT", "INT", "DINT", "LINT"].into_iter().flat_map(|ty| [100, 1000, 10_000].map(|size| (ty, size)));
    table(&heads, sizes.map(|(ty, size)| program_size(ty.to_owned(), size, &numbers(ty, size))));
}

fn program_size(name: String, instructions: usize, text: &str) -> Vec<String> {
    let source = Source::new("generated", text);
    let read = || {
        let (unit, errors) = syntax::parse(&source);
        semantics::check(&unit, errors.is_empty()).0
    };
    let Some(program) = read() else { unreachable!("the generator writes programs without errors") };
    let translate = || System::new(flatten(&program), Plant::default());
    let [(reading, ()), (translating, ())] = shortest(RUNS, [&mut || drop(read()), &mut || drop(translate())]);
    let System { program, net, .. } = translate();
    let each = (reading + translating).as_nanos() / instructions as u128;
    let counts = [program.end(), net.places().len(), net.transitions().len()];
    let times = [reading.as_micros(), translating.as_micros(), each];
    let numbers = counts.iter().map(usize::to_string).chain(times.iter().map(u128::to_string));
    std::iter::once(name).chain(numbers).collect()
}

/// Every scan state, found on so many threads.
fn explored(space: &ScanSpace<'_>, threads: usize) -> Graph {
    let search = || explore(space, Budget::default(), &mut |_| None);
    match ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(search),
        Err(error) => unreachable!("{error}"),
    }
}

/// How often in a second, in millions.
fn rate(count: u64, time: Duration) -> String {
    format!("{:.2}", count as f64 / time.as_secs_f64() / 1e6)
}

fn milliseconds(time: Duration) -> String {
    format!("{:.1}", time.as_secs_f64() * 1e3)
}

fn ratio(a: Duration, b: Duration) -> String {
    format!("{:.1}", a.as_secs_f64() / b.as_secs_f64())
}

/// What a state takes, its steps included.
fn bytes(graph: &Graph) -> String {
    (graph.bytes() / graph.len() as u64).to_string()
}

fn scan_view(sizes: &[(usize, usize)], runs: usize) {
    let heads =
        ["program", "lines", "states", "steps", "ms", "M states/s", "M steps/s", "M lines/s", "bytes per state"];
    let rows = sizes.iter().map(|&(inputs, scans)| {
        let system = system(&filters(inputs, scans));
        let (lines, space) = (system.program.end() as u64, ScanSpace::new(&system));
        let [(time, graph)] = shortest(runs, [&mut || explored(&space, 2)]);
        let mut row = vec![format!("{inputs} × {scans}")];
        row.extend([lines, graph.len() as u64, graph.steps()].map(|count| count.to_string()));
        row.push(milliseconds(time));
        row.extend([graph.len() as u64, graph.steps(), graph.steps() * lines].map(|count| rate(count, time)));
        row.push(bytes(&graph));
        row
    });
    table(&heads, rows);
}

fn both_views() {
    let heads = [
        "program",
        "scan states",
        "markings",
        "ratio",
        "scan view, ms",
        "transition view, ms",
        "ratio",
        "M markings/s",
        "bytes per marking",
    ];
    let rows = [(2, 2), (2, 3), (2, 4), (2, 5), (2, 6), (3, 3), (3, 4)].into_iter().map(|(inputs, scans)| {
        let system = system(&filters(inputs, scans));
        let space = ScanSpace::new(&system);
        let [(scan_time, states)] = shortest(RUNS, [&mut || explored(&space, 2)]);
        let markings = || Markings::explored(&system.net, Budget::default(), &mut |_| None);
        let [(firing_time, markings)] = shortest(RUNS, [&mut || markings()]);
        let markings = markings.graph();
        vec![
            format!("{inputs} × {scans}"),
            states.len().to_string(),
            markings.len().to_string(),
            format!("{:.0}", markings.len() as f64 / states.len() as f64),
            milliseconds(scan_time),
            milliseconds(firing_time),
            ratio(firing_time, scan_time),
            rate(markings.len() as u64, firing_time),
            bytes(markings),
        ]
    });
    table(&heads, rows);
}

fn threads() {
    let rows = [(3, 5), (2, 9), (3, 6)].into_iter().map(|(inputs, scans)| {
        let system = system(&filters(inputs, scans));
        let space = ScanSpace::new(&system);
        let [(one, graph), (two, _)] = shortest(RUNS, [&mut || explored(&space, 1), &mut || explored(&space, 2)]);
        let (program, states) = (format!("{inputs} × {scans}"), graph.len().to_string());
        vec![program, states, milliseconds(one), milliseconds(two), ratio(one, two)]
    });
    table(&["program", "states", "1 thread, ms", "2 threads, ms", "ratio"], rows);
}
