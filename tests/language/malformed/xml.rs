//! PNML files that XML's fine print makes: what a stream could miss that a tree would not.

use std::fs;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use super::{MANY, refused, run};
use support::process::petril;

const HEAD: &str = "<pnml xmlns='http://www.pnml.org/version-2009/grammar/pnml'>\
    <net id='n' type='http://www.pnml.org/version-2009/grammar/ptnet'><page id='g'>\n";
const TAIL: &str = "</page></net></pnml>";

fn page(page: &str) -> String {
    format!("{HEAD}{page}{TAIL}")
}

fn is_refused(text: impl AsRef<[u8]>, place: &str, words: &[&str]) {
    let run = run(&[("n.pnml", text.as_ref())], &["net", "info", "n.pnml"]);
    refused(&run, &format!("n.pnml:{place}"), words);
}

/// What is printed of a net that is read.
fn info(text: impl AsRef<[u8]>) -> String {
    let run = run(&[("n.pnml", text.as_ref())], &["net", "info", "n.pnml"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    run.stdout
}

#[test]
fn texts_are_the_same_however_they_are_written() {
    let dead = |text: &str| {
        let transition = format!("<transition id='t'><name>{text}</name></transition>");
        info(page(&format!("<place id='p'/>{transition}<arc id='a' source='p' target='t'/>")))
    };
    let written = [
        "<text>a&lt;b</text>",
        "<text><![CDATA[a<b]]></text>",
        "<text>\r\n a<![CDATA[]]>&#60;<!-- a comment &x; <text> --><?a pi?>b\t</text>",
        "<text>&#x61;&#x3C;&#98;</text><text>other</text>",
        "<graphics><text>other</text></graphics><text>a<i>other</i>&lt;b</text>",
    ];
    let all: Vec<String> = written.iter().map(|text| dead(text)).collect();
    assert!(all[0].contains("dead         1 transition: a<b\n"), "{}", all[0]);
    assert!(all.iter().all(|info| *info == all[0]), "{all:#?}");
    let tokens = "<initialMarking><text> <!-- two --> <![CDATA[ 1 ]]> </text></initialMarking>";
    assert!(info(page(&format!("<place id='p'>{tokens}</place>"))).contains("markings     1 reachable"));
    let twelve = page("<place id='p'><initialMarking><text>1<!-- -->2</text></initialMarking></place>");
    assert!(info(twelve).contains("tokens       12 in a place at most, 12 in a marking\n"));
}

#[test]
fn byte_order_marks_prefixes_and_latin_letters_are_read() {
    let text = page("<place id='p'/>");
    let expected = info(&text);
    assert_eq!(info(format!("\u{feff}{text}")), expected);
    assert_eq!(info(format!("\u{feff}<?xml version='1.0' encoding='utf-8'?>{text}")), expected);
    let prefixed = text.replace("<p", "<x:p").replace("</p", "</x:p").replace("xmlns=", "xmlns:x=");
    assert_eq!(info(prefixed.replace("<net", "<x:net").replace("</net", "</x:net")), expected);
    let latin = b"<?xml version='1.0' encoding=\"ISO-8859-1\"?><!-- T\xFCr -->".iter().copied();
    assert_eq!(info(latin.chain(text.bytes()).collect::<Vec<u8>>()), expected);
}

#[test]
fn other_encodings_are_refused() {
    is_refused("<?xml version='1.0' encoding='UTF-16'?><pnml/>", "1:31", &["`UTF-16`", "save it as UTF-8"]);
    is_refused("<?xml version='1.0' encoding='Shift_JIS'?><pnml/>", "1:31", &["`Shift_JIS`"]);
    is_refused(b"<pnml>T\xFCr</pnml>", "1:8", &["not written in UTF-8", "ISO-8859-1"]);
    is_refused(b"<?xml version='1.0' encoding='UTF-8'?>\n<pnml>\xE4</pnml>", "2:7", &["not written in UTF-8"]);
    is_refused(b"\xFF\xFE<\0p\0", "1:4", &["UTF-16"]);
    is_refused("<pnml>\u{1}</pnml>", "1:7", &["non-XML character"]);
    is_refused("<pnml>&#1;</pnml>", "1:7", &["no well-formed XML"]);
    is_refused("<pnml>\u{FFFF}</pnml>", "1:7", &["non-XML character"]);
}

#[test]
fn documents_that_break_off_are_refused_at_their_end() {
    let whole = page("<place id='p'>\n<name><text>&lt;<!-- c --><![CDATA[d]]></text></name></place><?pi x?>");
    let start = whole.find("<net").unwrap();
    for end in start..whole.len() {
        let run = run(&[("n.pnml", &whole.as_bytes()[..end])], &["net", "info", "n.pnml"]);
        refused(&run, "", &["no well-formed XML"]);
    }
}

#[test]
fn what_is_not_well_formed_is_refused_where_it_is() {
    let table = [
        ("<pnml></pnml><pnml/>", "1:14", "second element"),
        ("<pnml/>text", "1:8", "outside the root"),
        ("text<pnml/>", "1:1", "outside the root"),
        ("<pnml/>&lt;", "1:8", "outside the root"),
        ("<pnml/></pnml>", "1:8", "unexpected close tag"),
        (" <?xml version='1.0'?><pnml/>", "1:2", "at the beginning"),
        ("<pnml a='1' a='2'/>", "1:1", "'a' is already defined"),
        ("<pnml a=1/>", "1:9", "quotation marks"),
        ("<pnml a/>", "1:8", "no value"),
        ("<pnml a='<'/>", "1:10", "holds `<`"),
        ("<pnml a='1'b='2'/>", "1:12", "expected a blank"),
        ("<pnml a='&x;'/>", "1:10", "unknown entity reference 'x'"),
        ("<pnml a='&'/>", "1:10", "`&amp;`"),
        ("<pnml>a & b</pnml>", "1:9", "`&amp;`"),
        ("<pnml>]]></pnml>", "1:7", "]]>"),
        ("<pnml><!-- a -- b --></pnml>", "1:14", "`--`"),
        ("<pnml><!-- a", "1:13", "comment is never closed"),
        ("<pnml><![CDATA[ a", "1:18", "CDATA section is never closed"),
        ("<pnml><?a", "1:10", "never closed"),
        ("<pnml a='", "1:10", "never closed"),
        ("<pnml><!ELEMENT a></pnml>", "1:7", "begins nothing"),
        ("<1pnml/>", "1:1", "no name"),
        ("<pnml>< /></pnml>", "1:7", "no name"),
        ("<pnml>\n<a>\n</b></pnml>", "3:1", "expected 'a' tag, not 'b'"),
        ("<pnml><x:a/></pnml>", "1:7", "prefix 'x'"),
        ("<pnml><a x:b='1'/></pnml>", "1:7", "prefix 'x'"),
        ("<pnml><a xmlns:x='u'/><x:a/></pnml>", "1:23", "prefix 'x'"),
        ("<!doctype pnml><pnml/>", "1:1", "document type"),
        ("<!DOCTYPE pnml [<pnml/>", "1:1", "document type"),
    ];
    for (text, place, word) in table {
        is_refused(text, place, &["E0401", word]);
    }
}

/// Deep nesting, many attributes, many prefixes, long names: each is read in the time it takes to read it.
#[test]
fn hostile_documents_cost_no_more_than_their_length() {
    let n = MANY;
    let attributes: String = (0..n).map(|i| format!(" a{i}='x'")).collect();
    let prefixes: String = (0..n).map(|i| format!("<a xmlns:p{i}='u' xmlns='v{i}'>")).collect();
    let long = "x".repeat(10 * n);
    let documents = [
        page(&format!("<graphics{attributes}/>")),
        page(&format!("<toolspecific>{prefixes}{}</toolspecific>", "</a>".repeat(n))),
        page(&format!("<toolspecific>{}{}</toolspecific>", "<a>".repeat(n), "</a>".repeat(n))),
        page(&format!("<place id='{long}'><name><text>{long}</text></name></place>")),
        page(&format!("<place id='p'><name><text>{}</text></name></place>", "&lt;<!-- -->".repeat(n))),
        page(&format!("<!--{}-->", " - ".repeat(n))),
        page(&format!("<place id='p'/>{}", "<toolspecific tool='nupn'/>".repeat(n / 100))),
    ];
    let start = Instant::now();
    for document in documents {
        let run = run(&[("n.pnml", document.as_bytes())], &["net", "convert", "n.pnml", "-o", "n.net"]);
        assert_eq!(run.code, 0, "{}", run.stderr.chars().take(500).collect::<String>());
    }
    is_refused(page(&format!("<place id='p'><{}:a/></place>", "x".repeat(n))), "2:15", &["prefix"]);
    is_refused(page(&"&lt".repeat(n)), "2:1", &["`&amp;`"]);
    assert!(start.elapsed() < Duration::from_secs(60));
}

/// A disk that is full leaves nothing behind, and the file that was there.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_breaks_no_file() {
    let folder = TempDir::new().unwrap();
    let lines: String = (0..2000).map(|i| format!("pl p{i} (1)\ntr t{i} p{i} -> q{i}\n")).collect();
    fs::write(folder.path().join("n.net"), lines).unwrap();
    for ending in ["pnml", "net", "lola", "andl", "pnt", "dot"] {
        let name = format!("full.{ending}");
        std::os::unix::fs::symlink("/dev/full", folder.path().join(&name)).unwrap();
        let run = petril(folder.path(), &["net", "convert", "n.net", "-o", &name]);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""));
        assert!(run.stderr.contains(&format!("cannot write `{name}`: no space left")), "{}", run.stderr);
    }
    // A limit on the size of files does to a file what a full disk does.
    let before = "old";
    fs::write(folder.path().join("out.pnml"), before).unwrap();
    let mut command = std::process::Command::new("sh");
    let line = "trap '' XFSZ; ulimit -f 20; exec $PETRIL net convert n.net -o out.pnml";
    command.args(["-c", line]).env("PETRIL", env!("CARGO_BIN_EXE_petril")).current_dir(folder.path());
    let run = support::process::run(command);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{}", run.stderr);
    assert!(run.stderr.contains("cannot write `out.pnml`: file too large"), "{}", run.stderr);
    assert_eq!(fs::read_to_string(folder.path().join("out.pnml")).unwrap(), before);
    let left = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 8, "the net, the old file and the links; no temporary");
}

/// A pipe that nobody reads, and one that ends.
#[cfg(unix)]
#[test]
fn a_closed_pipe_is_an_error_of_the_file() {
    let folder = TempDir::new().unwrap();
    let lines: String = (0..20_000).map(|i| format!("tr t{i} p{i} -> q{i}\n")).collect();
    fs::write(folder.path().join("n.net"), lines).unwrap();
    std::os::unix::fs::symlink("/dev/stdout", folder.path().join("out.pnml")).unwrap();
    let mut command = std::process::Command::new("sh");
    let line = "{ $PETRIL net convert n.net -o out.pnml; echo $? >&2; } | head -c 5";
    command.args(["-c", line]).env("PETRIL", env!("CARGO_BIN_EXE_petril")).current_dir(folder.path());
    let run = support::process::run(command);
    assert_eq!(run.stdout, "<?xml");
    assert!(run.stderr.ends_with("2\n") && run.stderr.contains("broken pipe"), "{}", run.stderr);
}
