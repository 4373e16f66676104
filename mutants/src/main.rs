//! Faults in one build: `plant` copies the repository and puts a switch before every fault, `measure` finds which tests come to
//! which switch, `run` turns them on, one at a time, and `report` counts.

mod defaults;
mod find;
mod measure;
mod plant;
mod process;
mod report;
mod run;
mod splice;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// The folder of the copy, outside the repository.
    #[arg(long, global = true, default_value = "/tmp/petril-mutants")]
    copy: PathBuf,
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Copy the repository, put faults into these files and folders of it, and leave out what does not compile.
    Plant { files: Vec<String> },
    /// Build test programs and write down what each test comes to, and how long it takes. `lib` is the library's own tests.
    Measure { programs: Vec<String> },
    /// Run tests against faults that have no result yet.
    Run(Chosen),
    /// Count outcomes by folder, or list the survivors.
    Report {
        #[arg(long)]
        survivors: bool,
    },
}

#[derive(Args)]
struct Chosen {
    /// Beginnings of the paths of files, in the order in which they are tried; all without any.
    files: Vec<String>,
    /// CPU time in seconds that a fault may take altogether.
    #[arg(long, default_value_t = 10.0)]
    budget: f64,
    /// Try survivors again.
    #[arg(long)]
    again: bool,
    /// Only these faults, whatever is known of them.
    #[arg(long, value_delimiter = ',')]
    faults: Vec<u32>,
    /// Only tests whose name has one of these in it, as `program::test`.
    #[arg(long, value_delimiter = ',')]
    tests: Vec<String>,
    /// Which part of the faults: `0/2` is the first of two.
    #[arg(long, default_value = "0/1")]
    shard: String,
}

fn main() {
    let Arguments { copy, verb } = Arguments::parse();
    match verb {
        Verb::Plant { files } => plant::plant(&copy, &files),
        Verb::Measure { programs } => measure::measure(&copy, &programs),
        Verb::Run(chosen) => run::run(&copy, &chosen),
        Verb::Report { survivors } => report::report(&copy, survivors),
    }
}
