//! The figures of a project in docs/performance.md: `cargo bench --bench project`. `cargo bench --bench project -- write FOLDER` writes
//! the project of 50 programs with 500 requirements.
#![allow(clippy::unwrap_used, reason = "figures that cannot be made are of no use")]

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

/// Runs of each measurement, of which the shortest counts.
const RUNS: usize = 5;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if !arguments.iter().any(|argument| argument == "--bench") {
        return;
    }
    if let Some(folder) = arguments.iter().skip_while(|argument| *argument != "write").nth(1) {
        write_project(Path::new(folder));
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    write_project(folder.path());
    let check = |options: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_petril"));
        let begin = Instant::now();
        let output = command.arg("check").args(options).current_dir(folder.path()).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        (begin.elapsed(), text)
    };
    let shortest = |options: &[&str]| (0..RUNS).map(|_| check(options).0).min().unwrap();
    let row = |what: &str, time: Duration| println!("| {what} | {:.2} |", time.as_secs_f64());
    let text = check(&[]).1;
    let told = text.lines().filter(|line| line.starts_with("50 programs") || line.starts_with("500 requirements"));
    told.for_each(|line| println!("{line}"));
    println!("\n| run | seconds |\n|---|--:|");
    row("everything", shortest(&["--no-cache"]));
    row("everything, one thread", shortest(&["--no-cache", "--threads", "1"]));
    row("everything known", shortest(&[]));
    // One requirement of each of five programs is another one each time.
    let mut turn = 0;
    let times = (0..RUNS).map(|_| {
        turn += 1;
        for size in 6..=10 {
            let path = folder.path().join(format!("lines/vote_{size}.req"));
            let text = fs::read_to_string(&path).unwrap();
            let without = text.split("requirement another").next().unwrap();
            fs::write(path, format!("{without}requirement another: AG (A1 & B1 -> Out | {turn} = 0);\n")).unwrap();
        }
        check(&[]).0
    });
    row("one more requirement for each of five programs", times.min().unwrap());
}

/// The program of a size, with its requirements.
type Kind = fn(usize) -> (String, [String; 10]);

/// 50 programs of five kinds in ten sizes, with ten requirements each.
fn write_project(folder: &Path) {
    fs::create_dir_all(folder.join("lines")).unwrap();
    fs::write(folder.join("petril.toml"), "[[check]]\nprograms = \"lines/*.il\"\nrequirements = \"{stem}.req\"\n")
        .unwrap();
    let kinds: [(&str, Kind); 5] =
        [("starter", starter), ("sequence", sequence), ("delay", delay), ("count", count), ("vote", vote)];
    for (kind, write) in kinds {
        for size in 1..=10 {
            let (program, requirements) = write(size);
            let mut text = String::new();
            for (number, requirement) in requirements.iter().enumerate() {
                writeln!(text, "requirement {kind}_{}:\n    {requirement}", number + 1).unwrap();
            }
            fs::write(folder.join(format!("lines/{kind}_{size}.il")), program).unwrap();
            fs::write(folder.join(format!("lines/{kind}_{size}.req")), text).unwrap();
        }
    }
}

/// The names `name1`, `name2`, … with something between them.
fn names(name: &str, numbers: impl Iterator<Item = usize>, between: &str) -> String {
    numbers.map(|number| format!("{name}{number}")).collect::<Vec<_>>().join(between)
}

/// Motors with a start button each, of which neighbours exclude each other, and one stop button.
fn starter(size: usize) -> (String, [String; 10]) {
    let n = 2 + size / 2;
    let mut code = String::new();
    for i in 1..=n {
        write!(code, "    LD Start{i}\n    OR Motor{i}\n    AND Stop\n").unwrap();
        let neighbours = [i - 1, i + 1].into_iter().filter(|&j| (1..=n).contains(&j));
        neighbours.for_each(|j| writeln!(code, "    ANDN Motor{j}").unwrap());
        writeln!(code, "    ST Motor{i}").unwrap();
    }
    if size.is_multiple_of(2) {
        code += "    LD Motor1\n    OR Motor2\n    ST Lamp\n";
    }
    let motors = names("Motor", 1..=n, ", ");
    let lamp = if size.is_multiple_of(2) { ", Lamp" } else { "" };
    let program = format!(
        "PROGRAM starter\nVAR_INPUT {}, Stop : BOOL; END_VAR\nVAR_OUTPUT {motors}{lamp} : BOOL; END_VAR\n{code}END_PROGRAM\n",
        names("Start", 1..=n, ", ")
    );
    let requirements = [
        "AG !(Motor1 & Motor2);".to_owned(),
        format!("mutual_exclusion(Motor{}, Motor{n});", n - 1),
        format!("AG (!Stop -> !({}));", names("Motor", 1..=n, " | ")),
        "If Motor1 is true at the end of a scan, Start1 was true at the beginning of this or an earlier scan."
            .to_owned(),
        "AG (rising(Motor1) -> Start1);".to_owned(),
        format!("repeatability(Motor{n});"),
        "AG EF !Motor1;".to_owned(),
        format!("AG (rising(Motor{n}) -> Start{n} & Stop);"),
        "AG (Motor1 -> AX (Stop & !Motor2 -> Motor1));".to_owned(),
        format!("mutual_exclusion({motors});"),
    ];
    (program, requirements)
}

/// Steps one after another, each with a condition to go on, and a way back to the first.
fn sequence(size: usize) -> (String, [String; 10]) {
    let n = 3 + size;
    let mut code = String::from("    LD Reset\n    JMPC back\n");
    for i in 1..n {
        let next = i + 1;
        write!(
            code,
            "    LD Step{i}\n    AND Go{i}\n    JMPCN no{i}\n    R Step{i}\n    S Step{next}\n    JMP out\nno{i}:\n"
        )
        .unwrap();
    }
    write!(code, "    JMP out\nback:\n    LD TRUE\n    S Step1\n").unwrap();
    (2..=n).for_each(|i| writeln!(code, "    R Step{i}").unwrap());
    write!(code, "out:\n    LD Step{n}\n    ST Done\n").unwrap();
    let program = format!(
        "PROGRAM sequence\nVAR_INPUT {}, Reset : BOOL; END_VAR\nVAR Step1 : BOOL := TRUE; {} : BOOL; END_VAR\n\
         VAR_OUTPUT Done : BOOL; END_VAR\n{code}END_PROGRAM\n",
        names("Go", 1..n, ", "),
        names("Step", 2..=n, ", "),
    );
    let requirements = [
        format!("AG ({} = 1);", names("Step", 1..=n, " + ")),
        format!("mutual_exclusion({});", names("Step", 1..=n, ", ")),
        "AG EF Step1;".to_owned(),
        "AG EF Done;".to_owned(),
        format!("AG (Done <-> Step{n});"),
        format!("A [!Done W Step{}];", n - 1),
        "leadsto(Step3, Step2);".to_owned(),
        "AG (Reset -> Step1);".to_owned(),
        format!("AG (rising(Done) -> Go{});", n - 1),
        "response(Step1, Done, 5 scans);".to_owned(),
    ];
    (program, requirements)
}

/// A lamp that goes on some scans after a button, by a timer, and a horn if it is held twice as long.
fn delay(size: usize) -> (String, [String; 10]) {
    let (short, long) = (20 * size, 40 * size);
    let program = format!(
        "PROGRAM delay\nVAR_INPUT Button, Ready : BOOL; END_VAR\nVAR T1, T2 : TON; END_VAR\nVAR_OUTPUT Lamp, Horn : BOOL; END_VAR\n    \
         LD Button\n    AND Ready\n    ST T1.IN\n    CAL T1(PT := T#{short}ms)\n    LD T1.Q\n    ST Lamp\n    \
         LD Button\n    ST T2.IN\n    CAL T2(PT := T#{long}ms)\n    LD T2.Q\n    AND Lamp\n    ST Horn\nEND_PROGRAM\n"
    );
    let requirements = [
        "AG (Lamp <-> T1.Q);".to_owned(),
        "AG (Lamp -> Button & Ready);".to_owned(),
        "AG (Horn -> Lamp);".to_owned(),
        format!("If Button & Ready is true at the end of a scan and stays so for T#{}ms, Lamp is true.", short + 20),
        format!("AG (Lamp -> held(Button, T#{short}ms));"),
        "AG EF Horn;".to_owned(),
        "AG EF !Lamp;".to_owned(),
        "AG (!Button -> !Horn & !Lamp);".to_owned(),
        "changes_only_if(Horn, Lamp | pre(Lamp));".to_owned(),
        format!("AG (T1.ET <= T#{short}ms & T2.ET <= T#{long}ms);"),
    ];
    (program, requirements)
}

/// Pieces that are counted up and down, between limits.
fn count(size: usize) -> (String, [String; 10]) {
    let most = 12 * size;
    let program = format!(
        "PROGRAM count\nVAR_INPUT In, Out : BOOL; END_VAR\nVAR Pieces : INT; END_VAR\nVAR_OUTPUT Full, Empty : BOOL; END_VAR\n    \
         LD In\n    ANDN Full\n    JMPCN less\n    LD Pieces\n    ADD 1\n    ST Pieces\nless:\n    LD Out\n    ANDN Empty\n    \
         JMPCN flags\n    LD Pieces\n    GT 0\n    JMPCN flags\n    LD Pieces\n    SUB 1\n    ST Pieces\nflags:\n    LD Pieces\n    \
         GE {most}\n    ST Full\n    LD Pieces\n    LE 0\n    ST Empty\nEND_PROGRAM\n"
    );
    let requirements = [
        format!("AG (Pieces >= 0 & Pieces <= {most});"),
        "AG !(Full & Empty);".to_owned(),
        format!("AG (Full <-> Pieces >= {most});"),
        "AG (Empty <-> Pieces = 0);".to_owned(),
        "AG EF Full;".to_owned(),
        "AG EF Empty;".to_owned(),
        "AG (Pieces > pre(Pieces) -> In);".to_owned(),
        "AG (Pieces - pre(Pieces) <= 1);".to_owned(),
        "AG (In & !Out & !Full -> Pieces >= pre(Pieces));".to_owned(),
        format!("AG (Pieces < {most});"),
    ];
    (program, requirements)
}

/// Two of three contacts, each seen in several scans.
fn vote(size: usize) -> (String, [String; 10]) {
    let n = 1 + size.div_ceil(2).min(4);
    let mut code = String::new();
    for x in ["A", "B", "C"] {
        (2..=n).rev().for_each(|i| write!(code, "    LD {x}{}\n    ST {x}{i}\n", i - 1).unwrap());
        write!(code, "    LD {x}\n    ST {x}1\n").unwrap();
        (2..=n).for_each(|i| writeln!(code, "    AND {x}{i}").unwrap());
        writeln!(code, "    ST Sure{x}").unwrap();
    }
    for (x, y, first) in [("A", "B", true), ("A", "C", false), ("B", "C", false)] {
        write!(
            code,
            "    {} Sure{x}\n    AND Sure{y}\n{}",
            if first { "LD" } else { "OR(" },
            if first { "" } else { "    )\n" }
        )
        .unwrap();
    }
    let (hold, and) = if size.is_multiple_of(2) { (", Hold", "    ANDN Hold\n") } else { ("", "") };
    writeln!(code, "{and}    ST Out").unwrap();
    let any = if size > 8 { ", Any" } else { "" };
    if size > 8 {
        code += "    LD A1\n    OR B1\n    OR C1\n    ST Any\n";
    }
    let program = format!(
        "PROGRAM vote\nVAR_INPUT A, B, C{hold} : BOOL; END_VAR\nVAR {}, {}, {}, SureA, SureB, SureC : BOOL; END_VAR\n\
         VAR_OUTPUT Out{any} : BOOL; END_VAR\n{code}END_PROGRAM\n",
        names("A", 1..=n, ", "),
        names("B", 1..=n, ", "),
        names("C", 1..=n, ", "),
    );
    let requirements = [
        "AG (Out -> A + B + C >= 2);".to_owned(),
        "AG (Out -> SureA + SureB + SureC >= 2);".to_owned(),
        "AG (A1 <-> A);".to_owned(),
        format!("AG (SureA -> pre(A{}));", n - 1),
        "AG EF Out;".to_owned(),
        "AG EF !Out;".to_owned(),
        "AG (!A & !B -> !Out);".to_owned(),
        "forbidden(Out & !SureA & !SureB);".to_owned(),
        "AG (Out -> AX (!A & !C -> !Out));".to_owned(),
        "AG (A & B -> Out);".to_owned(),
    ];
    (program, requirements)
}
