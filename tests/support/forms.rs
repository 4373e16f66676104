//! Reports in many situations, and programs whose names and texts are meant to do harm.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

/// Examples and the net and requirement file they are checked with.
pub const EXAMPLES: [(&str, &str); 16] = [
    ("bottle-counter", "bottle-counter"),
    ("bottle-counter-broken", "bottle-counter"),
    ("drill-station", "drill-station"),
    ("emergency-stop", "emergency-stop"),
    ("emergency-stop-broken", "emergency-stop"),
    ("latching-starter", "latching-starter"),
    ("reversing-motor", "reversing-motor"),
    ("reversing-motor-broken", "reversing-motor"),
    ("star-delta", "star-delta"),
    ("star-delta-broken", "star-delta"),
    ("tank", "tank"),
    ("tank-broken", "tank"),
    ("two-hand-control", "two-hand-control"),
    ("two-hand-control-broken", "two-hand-control"),
    ("two-hand-switch", "two-hand-switch"),
    ("two-hand-switch-broken", "two-hand-switch"),
];

/// The folder in which the names of examples mean something.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).expect("the project is two folders above").to_path_buf()
}

/// A schema of the project, made stricter: members that it does not know are errors. So nothing is reported that is not
/// described.
pub fn schema(name: &str) -> jsonschema::Validator {
    fn close(schema: &mut Value) {
        if let Value::Object(members) = schema {
            if members.contains_key("properties") && members.contains_key("required") {
                members.insert("additionalProperties".to_owned(), Value::Bool(false));
            }
            members.values_mut().for_each(close);
        } else if let Value::Array(items) = schema {
            items.iter_mut().for_each(close);
        }
    }
    let text = fs::read_to_string(root().join(format!("docs/schema/{name}.schema.json"))).unwrap();
    let mut schema: Value = serde_json::from_str(&text).unwrap();
    assert!(jsonschema::draft202012::meta::is_valid(&schema));
    close(&mut schema);
    jsonschema::draft202012::new(&schema).unwrap()
}

/// The arguments that check an example.
pub fn example(program: &str, plant: &str) -> Vec<String> {
    let arguments = [
        "check".to_owned(),
        format!("examples/{program}.il"),
        "--plant".to_owned(),
        format!("nets/{plant}.net"),
        "--require".to_owned(),
        format!("examples/{plant}.req"),
    ];
    arguments.to_vec()
}

/// Checks that have each kind of answer, with the exit code they end with.
pub fn situations() -> Vec<(i32, Vec<String>)> {
    let switch = "check examples/two-hand-switch.il --plant nets/two-hand-switch.net";
    let tank = "check tests/cli/numbers.in/tank.il";
    let texts = [
        // Nothing is asked, and everything is.
        (0, switch.to_owned(), vec![]),
        (0, switch.to_owned(), vec!["AG (S1 & O1 -> Output)"]),
        (1, format!("{switch} --by-line"), vec!["AF Output", "AG !Output", "EF Output", "AG (S1 -> AX S1)"]),
        (1, format!("{switch} --view transition"), vec!["AF Output", "AG !at line 3", "EF Output"]),
        (0, format!("{switch} --view transition --fair"), vec!["AF at line 3"]),
        (3, format!("{switch} --max-states 3"), vec!["AG !Step_2", "EF Output"]),
        // Patterns, tags, an assumption, an assertion in the program, a premise that never comes.
        (1, "check tests/forms/gate.il --require tests/forms/gate.req".to_owned(), vec![]),
        // Errors of arithmetic.
        (1, tank.to_owned(), vec![]),
        (1, format!("{tank} --by-line"), vec!["AG TRUE"]),
        // Bad usage and bad input.
        (2, "check no-such-file.il".to_owned(), vec![]),
        (2, "check README.md".to_owned(), vec![]),
        (2, switch.to_owned(), vec!["AG Nonsense"]),
    ];
    let line = |text: String, formulas: Vec<&str>| {
        let formulas = formulas.into_iter().flat_map(|formula| ["-r".to_owned(), formula.to_owned()]);
        text.split(' ').map(str::to_owned).collect::<Vec<_>>().into_iter().chain(formulas).collect()
    };
    texts.into_iter().map(|(code, text, formulas)| (code, line(text, formulas))).collect()
}
