//! Command-line arguments, as typed.

use std::path::PathBuf;

use clap::{ArgAction, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use petril::verdict::Examination;

use super::bounds::Bounds;
use super::forms::Forms;
use super::meaning::{Meaning, Reading};
use super::sif::args::SifVerb;

/// Proves PLC programs in IEC 61131-3 Instruction List right, or shows the exact scan in which they go wrong.
///
/// Exit codes: 0 everything holds, 1 something is violated, 2 bad usage or input, 3 undecided.
#[derive(Debug, Parser)]
#[command(name = "petril", version = env!("PETRIL_VERSION"), max_term_width = 100)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
    /// Colours in messages.
    #[arg(long = "color", alias = "colour", value_name = "WHEN", value_enum, default_value_t = When::Auto, global = true, display_order = 900)]
    pub colour: When,
}

/// When to use colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum When {
    /// If the terminal has them and NO_COLOR is not set.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Check a program against requirements.
    Check(Check),
    /// Write the Petri net of a program and its plant.
    Translate(Translate),
    /// Print the flat code of a program: numbered lines without parentheses and labels.
    Flat(Flat),
    /// Run a program scan by scan and print its variables.
    Simulate(Simulate),
    /// Draw the subnet of an instruction.
    Draw(Draw),
    /// Work on any place/transition net.
    #[command(subcommand)]
    Net(NetVerb),
    /// Check, test and prove safety functions, which Boolean formulas specify.
    #[command(subcommand)]
    Sif(SifVerb),
    /// Explain a code like E0201 that stands in a message.
    Explain(Explain),
    /// Write an example of a project, to begin with.
    Init(Init),
    /// Print what a shell needs to complete command lines.
    Completions(Completions),
    /// Print the manual page, or write those of all verbs.
    Man(Manual),
}

/// `petril init`
///
/// Writes a program with a fault, its plant, its requirements, and a project file, so that `petril check` alone checks them. No
/// file is overwritten.
#[derive(Debug, clap::Args)]
pub struct Init {
    /// The folder to write into. It is made if it does not exist.
    #[arg(value_name = "FOLDER", default_value = ".")]
    pub folder: PathBuf,
}

/// `petril completions`
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Examples:
  petril completions bash > ~/.local/share/bash-completion/completions/petril
  petril completions zsh > ~/.zfunc/_petril
  petril completions fish > ~/.config/fish/completions/petril.fish")]
pub struct Completions {
    /// The shell.
    #[arg(value_name = "SHELL", value_enum)]
    pub shell: Shell,
}

/// `petril man`
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Examples:
  petril man | man -l -
  petril man -o ~/.local/share/man/man1")]
pub struct Manual {
    /// Write a page for each verb into this folder.
    #[arg(short, long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
}

/// `petril check`
///
/// All reachable states are explored, so a verdict `holds` is a proof under the assumptions the report lists, and
/// `violated` comes with a shortest run that shows it, replayed on the net and in the interpreter.
///
/// Without a program, all programs of the project file are checked. Then --html, --csv, --trace-csv and --vcd name folders.
#[derive(Clone, Debug, clap::Args)]
#[command(after_long_help = "\
Formulas are CTL: AG EF AX EX AF EG, A [p U q], E [p U q] and W (weak until) over the program's variables, with
! & | -> <-> and comparisons of sums; or LTL, after this word: LTL G (p -> F q). A state is the valuation of all
variables at the end of a scan, a step is one scan.

Examples:
  petril check press.il -r 'AG (Down -> Left & Right)'
  petril check press.il --plant buttons.net --require press.req --json
  petril check press.il --require press.req --html press.html --junit press.xml
  petril check press.il --view transition -r 'AG (at line 3 -> CuttingAllowed)'

A requirement file:
  // comment
  requirement both_hands \"The press closes only while both buttons are pressed\":
      AG (Down -> Left & Right);")]
pub struct Check {
    /// The program: Instruction List, or a PLCopen project in XML. Without one, those of the project file are checked.
    #[arg(value_name = "PROGRAM", conflicts_with_all = ["project", "only"])]
    pub program: Option<PathBuf>,
    /// The project file; if neither it nor a program is given, the `petril.toml` of this folder or of the nearest one above.
    #[arg(long, value_name = "FILE", help_heading = "Projects")]
    pub project: Option<PathBuf>,
    /// Check only the programs of the project whose names match, like `lines/*`. May be given several times.
    #[arg(long, value_name = "NAME", help_heading = "Projects")]
    pub only: Vec<String>,
    /// Compute everything again, and keep nothing for the next time.
    #[arg(long, help_heading = "Projects")]
    pub no_cache: bool,
    /// Check again whenever a file changes.
    #[arg(long, help_heading = "Projects")]
    pub watch: bool,
    /// A plant: a safe net (.net or .pnml) whose places named like `S1=1,O1=0` drive inputs. Inputs that no plant drives
    /// are free. May be given several times.
    #[arg(long, value_name = "NET", requires = "program")]
    pub plant: Vec<PathBuf>,
    /// A file of requirements. May be given several times.
    #[arg(long, value_name = "FILE", requires = "program")]
    pub require: Vec<PathBuf>,
    /// A requirement as a formula. May be given several times.
    #[arg(short = 'r', long = "requirement", value_name = "FORMULA", allow_hyphen_values = true, requires = "program")]
    pub requirement: Vec<String>,
    /// What an input can be that no plant drives, like `level: 0..100` or `k: 0, 3, 7`. May be given several times; a
    /// requirement file may say it too (`domain level: 0..100;`).
    #[arg(long, value_name = "DOMAIN", requires = "program")]
    pub domain: Vec<String>,
    /// Which runs count: those in which what is said here comes again and again, like `again and again !start`,
    /// `if again and again coil then again and again contact`, `released(start, reset)`, `pressed(stop)` or `plant`. May be
    /// given several times; a requirement file may say it too (`fair: released(start);`).
    #[arg(long, value_name = "ASSUMPTION", requires = "program")]
    pub fairness: Vec<String>,
    /// What a state is: the end of a scan, or a marking of the net.
    #[arg(long, value_enum, default_value_t = View::Scan)]
    pub view: View,
    /// Leave out runs in which the plant moves for ever and the PLC never scans again (transition view; in the scan view
    /// there are none).
    #[arg(long)]
    pub fair: bool,
    /// Print the report as one JSON document.
    #[arg(long)]
    pub json: bool,
    /// Tell the last scan of each counterexample line by line, with the current result.
    #[arg(long)]
    pub by_line: bool,
    /// Tell everything of each counterexample: a timing diagram, and the last scan line by line; and what was modelled.
    #[arg(long)]
    pub details: bool,
    /// Print the runs that show what is possible, too (for EF and its like), and an example of each requirement's premise.
    #[arg(long)]
    pub witnesses: bool,
    /// Show these variables of each run: names and patterns, like `Motor,Timer.*`, or `all`. If not given, those that the program
    /// declares, without what is local to instances of function blocks.
    #[arg(long, value_name = "VARS", requires = "program")]
    pub show: Vec<String>,
    /// Print every scan of a run, also those in which only clocks and counters go on.
    #[arg(long)]
    pub every_scan: bool,
    /// Draw timing diagrams and folded scans in ASCII alone.
    #[arg(long)]
    pub ascii: bool,
    /// What is written into files.
    #[command(flatten)]
    pub forms: Forms,
    /// What the program means on its PLC.
    #[command(flatten)]
    pub meaning: Meaning,
    /// Limits of the exploration.
    #[command(flatten)]
    pub limits: Limits,
}

/// Limits of an exploration. What is decided within them is printed; the rest is unknown.
#[derive(Clone, Debug, clap::Args)]
pub struct Limits {
    /// Stop after this many states [default: 100,000,000, for `net info` 2,000,000].
    #[arg(long, value_name = "N")]
    pub max_states: Option<u64>,
    /// Stop when this much memory is in use, in MiB [default: half of the machine's memory, or of its control group's].
    #[arg(long, value_name = "MIB")]
    pub max_memory: Option<u64>,
    /// Stop exploring after this many seconds.
    #[arg(long, value_name = "SECONDS")]
    pub timeout: Option<f64>,
    /// Threads to use; all processors if not given. The result is the same.
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
}

/// What a state is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum View {
    /// The valuation of all variables at the end of a scan; a step is one scan.
    Scan,
    /// A marking of the net; a step is one firing.
    Transition,
}

/// `petril translate`
#[derive(Debug, clap::Args)]
pub struct Translate {
    /// The program: Instruction List, or a PLCopen project in XML.
    #[arg(value_name = "PROGRAM")]
    pub program: PathBuf,
    /// A plant, as for `petril check`.
    #[arg(long, value_name = "NET")]
    pub plant: Vec<PathBuf>,
    /// Where to write; the ending chooses the format: .pnml, .net (TINA), .lola, .andl (Snoopy, MARCIE, Charlie), .pnt (INA),
    /// .dot, .svg.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Which unit, and how it is read.
    #[command(flatten)]
    pub reading: Reading,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// `petril flat`
#[derive(Debug, clap::Args)]
pub struct Flat {
    /// The program: Instruction List, or a PLCopen project in XML.
    #[arg(value_name = "PROGRAM")]
    pub program: PathBuf,
    /// Which unit, and how it is read.
    #[command(flatten)]
    pub reading: Reading,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// `petril simulate`
///
/// Without inputs, all keep their initial values. Results go to standard output, what is told about them to standard error.
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Examples:
  petril simulate press.il --inputs press.csv
  petril simulate press.il --plant buttons.net --random 7 --until 'Down & !Left' --by-line 12
  petril simulate press.il --random --scans 500 -o press.vcd
  petril check press.il --require press.req --json > report.json
  petril simulate press.il --replay report.json --requirement both_hands --interactive

Exit codes: 0 done, and the condition of --until was met; 1 it was not met, or a scan went wrong; 2 bad usage or input.")]
pub struct Simulate {
    /// The program: Instruction List, or a PLCopen project in XML.
    #[arg(value_name = "PROGRAM")]
    pub program: PathBuf,
    /// Values of the inputs (CSV): names in the first row, then one row a scan. Inputs without a column keep their initial
    /// value.
    #[arg(long, value_name = "CSV", conflicts_with_all = ["random", "replay", "plant"])]
    pub inputs: Option<PathBuf>,
    /// Inputs, and moves of the plant, by chance. The same seed gives the same run; without one, the seed is told.
    #[arg(long, value_name = "SEED", num_args = 0..=1, conflicts_with = "replay")]
    pub random: Option<Option<u64>>,
    /// The run of a report that `petril check --json` made: the same inputs, and with --plant the same moves of the plant. It
    /// is an error if anything becomes another value than in the report.
    #[arg(long, value_name = "REPORT.json")]
    pub replay: Option<PathBuf>,
    /// The requirement of the report whose run it is; if not given, the first that is violated.
    #[arg(long, value_name = "NAME", requires = "replay")]
    pub requirement: Option<String>,
    /// A plant, as for `petril check`: it moves by chance (--random), as it did (--replay), or as you say (--interactive). May
    /// be given several times.
    #[arg(long, value_name = "NET")]
    pub plant: Vec<PathBuf>,
    /// What an input can be that no plant drives, as for `petril check`. May be given several times.
    #[arg(long, value_name = "DOMAIN", conflicts_with_all = ["inputs", "replay"])]
    pub domain: Vec<String>,
    /// How many scans; if not given, one for each row of inputs or scan of the report, or 10, or 1000 with --until. Beyond the
    /// last row, inputs stay as they are; a run of the report that goes on for ever does so.
    #[arg(long, value_name = "N")]
    pub scans: Option<usize>,
    /// Stop after the first scan in which this is so: a formula without temporal operators, like `Bottles > 200 & !Full` or
    /// `rising(Motor)`.
    #[arg(long, value_name = "CONDITION", visible_alias = "break", allow_hyphen_values = true)]
    pub until: Option<String>,
    /// How to print; if not given, as the ending of the file says (.csv, .vcd), or a table.
    #[arg(long, value_enum)]
    pub format: Option<Format>,
    /// Tell a scan line by line below the table, with the current result.
    #[arg(long, value_name = "SCAN")]
    pub by_line: Option<usize>,
    /// Write to a file, which appears whole or not at all.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Step through the run in the terminal, forward and back, by scans, lines and transitions, and choose inputs by key.
    #[arg(short, long, conflicts_with_all = ["output", "format", "by_line", "until", "scans"])]
    pub interactive: bool,
    /// What the program means on its PLC.
    #[command(flatten)]
    pub meaning: Meaning,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// Forms of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// A table for people, in blocks of columns if the terminal is narrow.
    Table,
    /// First column `cycle`, then every variable.
    Csv,
    /// A value change dump for waveform viewers.
    Vcd,
}

/// `petril draw`
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Examples:
  petril draw --instruction AND -o and.svg
  petril draw --instruction 'JMPC' -o jmpc.svg
  petril draw press.il --line 3 -o line3.svg")]
pub struct Draw {
    /// A program; with --line, the subnet of one of its lines is drawn.
    #[arg(value_name = "PROGRAM", required_unless_present = "instruction")]
    pub program: Option<PathBuf>,
    /// The line of the program's flat code to draw, as `petril flat` numbers it.
    #[arg(long, value_name = "N", requires = "program")]
    pub line: Option<usize>,
    /// An operator to draw, without a program: LD LDN ST STN S R AND ANDN OR ORN XOR XORN NOT JMP JMPC JMPCN RET RETC
    /// RETCN.
    #[arg(long, value_name = "OPERATOR", conflicts_with = "program")]
    pub instruction: Option<String>,
    /// Where to write the SVG picture.
    #[arg(short, long, value_name = "FILE.svg")]
    pub output: PathBuf,
    /// Which unit, and how it is read.
    #[command(flatten)]
    pub reading: Reading,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// The verbs on nets.
#[derive(Debug, Subcommand)]
pub enum NetVerb {
    /// Print the structure of a net (classes, invariants, siphons, traps), and its behaviour if it is small: reachable markings,
    /// safe or not, deadlocks, dead transitions, live or not.
    Info(NetInfo),
    /// Answer questions about a net: formulas, or the properties of a file of the Model Checking Contest.
    Check(NetCheck),
    /// Count the states of a net, in the lines of the Model Checking Contest.
    Explore(OnNet),
    /// Write a smaller net that answers the same question.
    Reduce(NetReduce),
    /// Write a net in another format.
    Convert(NetConvert),
}

/// What every verb on nets takes.
#[derive(Debug, clap::Args)]
pub struct OnNet {
    /// The net (.pnml or .net): any place/transition net, with weights and any number of tokens.
    #[arg(value_name = "MODEL")]
    pub model: PathBuf,
    /// Print one JSON document.
    #[arg(long, action = ArgAction::SetTrue)]
    pub json: bool,
    /// Limits of the exploration.
    #[command(flatten)]
    pub limits: Limits,
}

/// `petril net convert`
#[derive(Debug, clap::Args)]
pub struct NetConvert {
    /// The net (.pnml or .net): any place/transition net, with weights and any number of tokens.
    #[arg(value_name = "MODEL")]
    pub model: PathBuf,
    /// Where to write; the ending chooses the format: .pnml, .net (TINA), .lola, .andl (Snoopy, MARCIE, Charlie), .pnt (INA),
    /// .dot.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// `petril net check`
#[derive(Debug, clap::Args)]
pub struct NetCheck {
    /// The net, and limits.
    #[command(flatten)]
    pub on: OnNet,
    /// Properties in the contest's XML, with the ids of the PNML file. May be given several times.
    #[arg(long, value_name = "XML", required_unless_present_any = ["formula", "examination"])]
    pub properties: Vec<PathBuf>,
    /// A question that the contest asks about every net. May be given several times.
    #[arg(long, value_name = "NAME", value_parser = examination)]
    pub examination: Vec<Examination>,
    /// A formula over the names of the net, like `AG (tokens("buffer") <= 3)`, `EF enabled("t") & marked("p")`, `AG !at deadlock`.
    #[arg(short = 'r', long = "formula", value_name = "FORMULA")]
    pub formula: Vec<String>,
    /// Print the firing sequences that show an answer, where any can, and what holds on their way: as a list, or the first
    /// one as the XML of TAPAAL.
    #[arg(long, value_name = "FORM", value_enum, num_args = 0..=1, require_equals = true, default_missing_value = "text")]
    pub trace: Option<TraceForm>,
}

/// Forms of a firing sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TraceForm {
    /// One transition a line, by name.
    Text,
    /// The XML that TAPAAL reads, with the ids of the PNML file.
    Tapaal,
}

/// Parses the name of an examination.
fn examination(name: &str) -> Result<Examination, String> {
    let found = Examination::ALL.into_iter().find(|examination| examination.name().eq_ignore_ascii_case(name));
    found.ok_or_else(|| format!("there are {}", Examination::ALL.map(Examination::name).join(", ")))
}

/// `petril net reduce`
#[derive(Debug, clap::Args)]
pub struct NetReduce {
    /// The net (.pnml or .net): any place/transition net, with weights and any number of tokens.
    #[arg(value_name = "MODEL")]
    pub model: PathBuf,
    /// Where to write; the ending chooses the format, as for `petril net convert`.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// A place whose tokens matter. May be given several times.
    #[arg(long, value_name = "PLACE")]
    pub keep: Vec<String>,
    /// A transition of which it matters whether it is enabled. May be given several times.
    #[arg(long, value_name = "TRANSITION")]
    pub keep_enabled: Vec<String>,
    /// What the smaller net is for.
    #[arg(long = "for", value_name = "PROPERTY", value_enum, default_value_t = Kept::Reachability)]
    pub property: Kept,
    /// Print one JSON document.
    #[arg(long, action = ArgAction::SetTrue)]
    pub json: bool,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// What a reduction keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Kept {
    /// What the kept places can have together.
    Reachability,
    /// The same, in dead markings, too.
    Deadlock,
    /// Any formula of CTL or LTL about the kept places.
    Paths,
}

/// `petril net info`
#[derive(Debug, clap::Args)]
pub struct NetInfo {
    /// The net, and limits.
    #[command(flatten)]
    pub on: OnNet,
    /// Print the invariants that were found.
    #[arg(long, action = ArgAction::SetTrue)]
    pub invariants: bool,
    /// Print the minimal siphons that were found.
    #[arg(long, action = ArgAction::SetTrue)]
    pub siphons: bool,
    /// Print the minimal traps that were found.
    #[arg(long, action = ArgAction::SetTrue)]
    pub traps: bool,
    /// Try so many times as hard to find all invariants, siphons and traps. With 1, no part takes much more than a second.
    #[arg(long, value_name = "TIMES", default_value_t = 1)]
    pub effort: u32,
}

/// `petril explain`
#[derive(Debug, clap::Args)]
pub struct Explain {
    /// The code, in capital or small letters. Without one, all codes are listed.
    #[arg(value_name = "CODE")]
    pub code: Option<String>,
}
