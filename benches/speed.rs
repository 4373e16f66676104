//! How long the parts of Petril take, measured with criterion: `cargo bench --bench speed`.

mod programs;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput};
use petril::draw::positions;
use petril::exchange::{notes, pnml, pnml::Extras};
use petril::explore::{Budget, Graph, Markings, ScanSpace, explore};
use petril::flat::flatten;
use petril::logic::{Dag, ScanValuation, label};
use petril::semantics;
use petril::source::Source;
use petril::syntax;
use petril::translate::{Plant, System};
use programs::{filters, formula, mixed, system};

/// Instructions of the programs that are read and translated.
const SIZES: [usize; 4] = [10, 100, 1000, 10_000];

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    reading(&mut criterion);
    translating(&mut criterion);
    exploring(&mut criterion);
    labelling(&mut criterion);
    exchanging(&mut criterion);
    criterion.final_summary();
}

/// Text to checked program.
fn reading(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("read");
    for size in SIZES {
        let source = Source::new("mixed", mixed(size));
        group.throughput(Throughput::Elements(size as u64));
        group.bench_function(BenchmarkId::from_parameter(size), |bencher| {
            bencher.iter(|| {
                let (unit, errors) = syntax::parse(&source);
                semantics::check(&unit, errors.is_empty())
            });
        });
    }
}

/// Checked program to system net.
fn translating(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("translate");
    for size in SIZES {
        let (unit, _) = syntax::parse(&Source::new("mixed", mixed(size)));
        let (program, _) = semantics::check(&unit, true);
        let Some(program) = program else { continue };
        group.throughput(Throughput::Elements(size as u64));
        group.bench_function(BenchmarkId::from_parameter(size), |bencher| {
            bencher.iter(|| System::new(flatten(&program), Plant::default()));
        });
    }
}

fn explored(space: &ScanSpace<'_>) -> Graph {
    explore(space, Budget::default(), &mut |_| None)
}

/// Both views, each of a program with free inputs and some hundred thousand states.
fn exploring(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("explore");
    group.sample_size(10);
    let system_of_scans = system(&filters(3, 5));
    let space = ScanSpace::new(&system_of_scans);
    group.throughput(Throughput::Elements(explored(&space).steps()));
    group.bench_function("scan view", |bencher| bencher.iter(|| explored(&space)));
    let system_of_markings = system(&filters(2, 5));
    let markings = || Markings::explored(&system_of_markings.net, Budget::default(), &mut |_| None);
    group.throughput(Throughput::Elements(markings().graph().steps()));
    group.bench_function("transition view", |bencher| bencher.iter(markings));
}

/// The states that satisfy a formula, on a graph of about a million states.
fn labelling(criterion: &mut Criterion) {
    const FORMULAS: [&str; 8] = [
        "AG (On0 -> Was0_0 | Was0_8 | In0)",
        "AG EF On1",
        "AG (In0 -> AX Was0_1)",
        "AG (!On0 -> AX (On0 -> Was0_8))",
        "AG (On0 -> A [On0 W !In0])",
        "AF On0",
        "EG !On0",
        "EF (On0 & EF (!On0 & On1))",
    ];
    let mut group = criterion.benchmark_group("label");
    group.sample_size(10);
    let system = system(&filters(2, 9));
    let space = ScanSpace::new(&system);
    let graph = explored(&space);
    // Predecessors are computed when first asked for, which is not to be counted.
    black_box(graph.rows_to(0));
    group.throughput(Throughput::Elements(graph.len() as u64));
    for text in FORMULAS {
        let bound = formula(text, &system);
        let mut dag = Dag::default();
        dag.add(&bound, false);
        let holds =
            |f: &petril::logic::Bound, id: u32| f.holds_in(&ScanValuation(&space, graph.state(id))) == Some(true);
        group.bench_function(text, |bencher| bencher.iter(|| label(&graph, &dag, &holds, None)));
    }
}

/// A net to PNML and back.
fn exchanging(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("pnml");
    let text = mixed(1000);
    let system = system(&text);
    let source = Source::new("mixed", text);
    let write = || {
        let (positions, notes) = (positions(&system), notes(&system, &source));
        pnml::write(&system.net, Extras { positions: Some(&positions), notes: Some(&notes), ..Extras::default() })
    };
    let written = Source::new("mixed.pnml", write());
    group.throughput(Throughput::Bytes(written.text().len() as u64));
    group.bench_function("write", |bencher| bencher.iter(write));
    group.bench_function("read", |bencher| bencher.iter(|| pnml::read(&written)));
}
