//! Lists of inputs and outputs become frames of specifications.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fs;
use std::io::Write as _;
use std::path::Path;

use petril::diagnostic::Code;
use petril::exchange::sif::list;
use petril::sif::Specification;
use petril::source::Source;
use proptest::prelude::*;
use support::process::petril;

const LIST: &str = "\
I/O list of the oven;;;;;;\n\
Tag;I/O;Description;Address;Zone;Function;Normal\n\
Hot;DI;thermostat \"T1\";%IX0.0;Oven;Heat;1\n\
Door 1/2;DI;door closed;Door_Closed;Oven;Heat;\n\
Heater;DO;heater off;%QX0.0;Oven;Heat;\n\
Reset;in;;;;;\n\
;;;;;;\n\
Lamp;;lamp;%QX0.1;;;\n\
not;I;a word of formulas;;Oven;Heat;0\n";

const FRAME: &str = "\
// The frame of a specification. Its formulas are to be written in.
system \"oven\";
input Reset;

zone Oven {

    function Heat {
        interface {
            input Hot \"thermostat 'T1'\" at %IX0.0 normally TRUE;
            input Door_1_2 \"door closed, Door 1/2\" is Door_Closed;
            input _not \"a word of formulas, not\";
            output Heater \"heater off\" at %QX0.0;
        }
        formal {
            // Heater = 
        }
    }
}

function Unassigned {
    interface {
        output Lamp \"lamp\" at %QX0.1;
    }
    formal {
        // Lamp = 
    }
}
";

#[test]
fn a_list_becomes_a_frame_whose_errors_are_what_is_left_to_do() {
    let rows = list::rows_of_text(LIST).unwrap();
    let frame = list::frame("oven", &rows).unwrap();
    // The row of the last input comes behind a zone that was left.
    let parts: Vec<&str> = FRAME.lines().filter(|line| !line.contains("_not")).collect();
    let made: Vec<&str> = frame.lines().filter(|line| !line.contains("_not")).collect();
    assert_eq!(made, parts, "{frame}");
    let (specification, diagnostics) = Specification::read(&[Source::new("oven.sif", frame.as_str())]);
    assert!(specification.is_none());
    let codes: Vec<Code> = diagnostics[0].iter().map(|diagnostic| diagnostic.code).collect();
    assert_eq!(codes, [Code::SifNotDefined, Code::SifNotDefined], "{diagnostics:?}");
    let whole = frame.replace("// Heater = ", "Heater = Hot & Door_1_2 & _not;").replace("// Lamp = ", "Lamp = Reset;");
    let (specification, diagnostics) = Specification::read(&[Source::new("oven.sif", whole)]);
    assert!(specification.is_some(), "{diagnostics:?}");
    assert_eq!(specification.unwrap().inputs().count(), 4);
}

/// Closed contacts are TRUE at rest, and addresses are addresses, however they are written.
#[test]
fn contacts_and_addresses_are_read() {
    let list = "name,address,contact\nA,%I0.0,NC\nB,I0.1,NO\nC,E0.2,\nD,Door.Closed,nc\nQ,A4.0,\nR,%q1.0,\n";
    let frame = list::frame("x", &list::rows_of_text(&list.replace("D,Door.Closed", "D,%IX1.0")).unwrap()).unwrap();
    for line in [
        "input A at %I0.0 normally TRUE;",
        "input B at %I0.1;",
        "input C at %I0.2;",
        "input D at %IX1.0 normally TRUE;",
        "output Q at %Q4.0;",
        "output R at %Q1.0;",
    ] {
        assert!(frame.lines().any(|made| made.trim() == line), "{line}\n{frame}");
    }
    let frame = list::frame("x", &list::rows_of_text("name,direction,variable\nD,in,Door.Closed\n").unwrap()).unwrap();
    assert!(frame.contains("input D is Door.Closed;"), "{frame}");
}

#[test]
fn what_is_not_boolean_is_refused() {
    let refused = |text: &str| list::frame("x", &list::rows_of_text(text).unwrap()).unwrap_err();
    for row in ["T,AI,,", "T,in,%IW4,", "T,in,EW4,", "T,in,%ID4,", "T,in,,REAL", "T,in,,int"] {
        let said = refused(&format!("name,direction,address,data type\n{row}\n"));
        assert!(said[0].starts_with("row 2: `T` is not Boolean"), "{row}: {said:?}");
    }
    let said = refused("name,direction,contact\nA,in,maybe\n");
    assert_eq!(said, ["row 2: `maybe` does not say what `A` is at rest: write NC or TRUE, NO or FALSE"]);
}

#[test]
fn what_is_no_list_is_refused() {
    let refused = |text: &str| list::frame("x", &list::rows_of_text(text).unwrap()).unwrap_err();
    assert!(refused("")[0].contains("no row is a head"));
    assert_eq!(
        refused("name,type\nA,\nB,in\nC,who knows\n"),
        [
            "row 2: nothing says whether `A` is an input or an output",
            "row 4: nothing says whether `C` is an input or an output",
        ]
    );
}

/// The least that a workbook is made of. There are no compressed parts, so that a test can write it by itself.
fn workbook(path: &Path, rows: &[&[&str]]) {
    let cell = |text: &&str| format!("<c t=\"inlineStr\"><is><t>{text}</t></is></c>");
    let row = |cells: &&[&str]| format!("<row>{}</row>", cells.iter().map(cell).collect::<String>());
    workbook_of(path, &rows.iter().map(row).collect::<String>(), None);
}

/// The same from its rows in XML; the directory may say that the sheet has another size.
fn workbook_of(path: &Path, rows: &str, said: Option<u32>) {
    let main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
    let office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let package = "http://schemas.openxmlformats.org/package/2006";
    let parts = [
        (
            "[Content_Types].xml",
            format!(
                "<Types xmlns=\"{package}/content-types\"><Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\
             <Default Extension=\"xml\" ContentType=\"application/xml\"/></Types>"
            ),
        ),
        (
            "_rels/.rels",
            format!(
                "<Relationships xmlns=\"{package}/relationships\"><Relationship Id=\"r1\" Type=\"{office}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/workbook.xml",
            format!(
                "<workbook xmlns=\"{main}\" xmlns:r=\"{office}\"><sheets><sheet name=\"IO\" sheetId=\"1\" r:id=\"r1\"/></sheets></workbook>"
            ),
        ),
        (
            "xl/_rels/workbook.xml.rels",
            format!(
                "<Relationships xmlns=\"{package}/relationships\"><Relationship Id=\"r1\" Type=\"{office}/worksheet\" Target=\"worksheets/sheet1.xml\"/></Relationships>"
            ),
        ),
        ("xl/worksheets/sheet1.xml", format!("<worksheet xmlns=\"{main}\"><sheetData>{rows}</sheetData></worksheet>")),
    ];
    let crc = |bytes: &[u8]| {
        !bytes.iter().fold(u32::MAX, |crc, byte| {
            (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xEDB8_8320 } else { crc >> 1 })
        })
    };
    let (mut file, mut directory) = (Vec::new(), Vec::new());
    for (name, text) in &parts {
        let (at, size) = (file.len() as u32, text.len() as u32);
        let mut common = [20_u16, 0, 0, 0, 0x21].map(u16::to_le_bytes).concat();
        common.extend([crc(text.as_bytes()), size, size].map(u32::to_le_bytes).concat());
        common.extend([name.len() as u16, 0].map(u16::to_le_bytes).concat());
        file.extend([b"PK\x03\x04", &common[..], name.as_bytes(), text.as_bytes()].concat());
        if let Some(said) = said.filter(|_| name.ends_with("sheet1.xml")) {
            common[18..22].copy_from_slice(&said.to_le_bytes());
        }
        directory.extend(
            [b"PK\x01\x02\x14\x00", &common[..], &[0; 6][..], &[0; 4], &at.to_le_bytes(), name.as_bytes()].concat(),
        );
    }
    let count = (parts.len() as u16).to_le_bytes();
    let end = [(directory.len() as u32).to_le_bytes(), (file.len() as u32).to_le_bytes()].concat();
    file.extend([&directory[..], b"PK\x05\x06\0\0\0\0", &count, &count, &end, &[0, 0]].concat());
    fs::File::create(path).unwrap().write_all(&file).unwrap();
}

#[test]
fn workbooks_are_read_and_files_written() {
    let folder = tempfile::tempdir().unwrap();
    let rows: Vec<Vec<&str>> = LIST.lines().map(|line| line.split(';').collect()).collect();
    let rows: Vec<&[&str]> = rows.iter().map(Vec::as_slice).collect();
    workbook(&folder.path().join("oven.xlsx"), &rows);
    fs::write(folder.path().join("oven.csv"), LIST).unwrap();
    let of = |list: &str| {
        let run = petril(folder.path(), &["sif", "import", list, "-o", "oven.sif"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        fs::read_to_string(folder.path().join("oven.sif")).unwrap()
    };
    let (workbook, text) = (of("oven.xlsx"), of("oven.csv"));
    assert_eq!(workbook, text);
    assert_eq!(petril(folder.path(), &["sif", "check", "oven.sif"]).code, 2);
    fs::write(folder.path().join("no.xlsx"), "no workbook").unwrap();
    let run = petril(folder.path(), &["sif", "import", "no.xlsx"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("no.xlsx"), "{}", run.stderr);
}

#[test]
fn workbooks_of_any_size_are_refused_or_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("far.xlsx");
    let cell = |place: &str, text: &str| format!("<c r=\"{place}\" t=\"inlineStr\"><is><t>{text}</t></is></c>");
    let head = format!("<row r=\"3\">{}{}</row>", cell("B3", "name"), cell("C3", "direction"));
    let line = format!("<row r=\"5\">{}{}</row>", cell("B5", "a"), cell("C5", "in"));
    let import = || petril(folder.path(), &["sif", "import", "far.xlsx"]);
    workbook_of(&path, &format!("{head}{line}"), None);
    assert!(import().stdout.contains("input a;"));
    // A cell that is only formatted is nothing.
    workbook_of(&path, &format!("{head}{line}<row r=\"1048576\"><c r=\"XFD1048576\" s=\"1\"/></row>"), None);
    assert!(import().stdout.contains("input a;"));
    for (place, row, column) in [("XFD1048576", 1_048_576, 16384), ("A100001", 100_001, 1), ("ALM4", 4, 1001)] {
        workbook_of(&path, &format!("{head}<row r=\"{row}\">{}</row>", cell(place, "x")), None);
        let run = import();
        let message = format!("far.xlsx: the cell in row {row}, column {column} is too far out");
        assert!(run.code == 2 && run.stderr.contains(&message), "{}", run.stderr);
    }
    let wide = |row: usize| format!("<row r=\"{row}\">{}</row>", cell(&format!("ALL{row}"), "x"));
    workbook_of(&path, &(1..=4001).map(wide).collect::<String>(), None);
    let run = import();
    assert!(run.code == 2 && run.stderr.contains("the cell in row 4001, column 1000 is too far out"), "{}", run.stderr);
    // A workbook that unpacks to more than a list can have.
    workbook_of(&path, &format!("{head}{line}"), Some(300 << 20));
    let run = import();
    assert!(run.code == 2 && run.stderr.contains("unpacked, the workbook has more than 256 MiB"), "{}", run.stderr);
}

proptest! {
    /// Whatever a list holds, what is made of it can be read, and nothing is missing but formulas.
    #[test]
    fn frames_can_be_read(rows in prop::collection::vec((".{1,12}", any::<bool>(), ".{0,12}", "[A-Za-z ]{0,6}", "[A-Za-z ]{0,6}"), 1..12)) {
        let mut table = vec![["name", "direction", "description", "zone", "function"].map(str::to_owned).to_vec()];
        for (number, (name, is_output, description, zone, function)) in rows.iter().enumerate() {
            let direction = if *is_output { "out" } else { "in" };
            let name = format!("{name}_{number}");
            table.push(vec![name, direction.to_owned(), description.clone(), zone.clone(), format!("F{function}{number}")]);
        }
        let frame = list::frame("random", &table).unwrap();
        let (_, diagnostics) = Specification::read(&[Source::new("x.sif", frame.as_str())]);
        for diagnostic in &diagnostics[0] {
            prop_assert!(diagnostic.code == Code::SifNotDefined || !diagnostic.is_error(), "{frame}\n{diagnostic:?}");
        }
    }
}
