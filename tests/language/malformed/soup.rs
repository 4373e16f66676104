//! Words of each language in any order: whatever is read, every diagnostic points into the text and can be printed.

use petril::diagnostic::{Diagnostic, Style, any_error, render};
use petril::exchange::{mcc, pnml, tina};
use petril::flat::flatten;
use petril::logic::{Nodes, View, bind_in_net, bind_requirement, parse_requirements};
use petril::source::Source;
use petril::translate::{Plant, System};
use petril::{semantics, syntax};
use proptest::prelude::*;

/// Whole elements most of the time, so that some documents are well-formed.
const PROJECT: &[&str] = &[
    "<pou name='f' pouType='function'><interface><returnType><INT/></returnType></interface><body><IL>LD 1\nST f</IL></body></pou>",
    "<pou name='b' pouType='functionBlock'><body><ST>x</ST></body></pou>",
    "<body><IL>LD a\nST &lt;<p>ä</p><![CDATA[(*]]></IL></body>",
    "<body><IL><simpleValue value='1'/>LD a</IL></body>",
    "</interface><body><IL>END_VAR\nLD 'x</IL></body></pou><pou pouType='program' name='p'><interface>",
    "</interface><body><IL/></body></pou><pou pouType='program' name='q'><interface>",
    "<inputVars retain='true'><variable name='i' address='%IX0.0'><type><BOOL/></type></variable></inputVars>",
    "<outputVars constant='true'><variable name='ö'><type><derived name='b'/></type></variable></outputVars>",
    "<globalVars><variable name='g'><type><array><dimension lower='1' upper='x'/><baseType><INT/></baseType></array></type>\
     <initialValue><arrayValue><value repetitionValue='3'><simpleValue value='&quot;'/></value></arrayValue></initialValue>\
     </variable></globalVars>",
    "<localVars><variable name='s'><type><struct><variable name='m'><type><BOOL/></type></variable></struct></type>\
     <initialValue><structValue><value member='m'><simpleValue value='TRUE'/></value></structValue></initialValue>\
     </variable></localVars>",
    "<localVars><variable name='e'><type><enum><values><value name='x'/></values></enum></type></variable></localVars>",
    "<localVars><variable name='r'><type><subrangeSigned><range lower='5' upper='1'/><baseType><INT/></baseType>\
     </subrangeSigned></type><initialValue><simpleValue value = '(x' /></initialValue></variable></localVars>",
    "<dataType name='t'><baseType><derived name='t'/></baseType></dataType>",
    "<configuration name='c'><task name='k' interval='x#'><pouInstance name='i' typeName='p'/></task></configuration>",
    "<accessVars><accessVariable/></accessVars>",
    "<actions><action name='a'/></actions>",
    "<returnType/>",
    "<interface>",
    "</interface>",
    "<!-- ä -->",
    "&#1;",
    "<",
    "\n",
];

const PROGRAM: &[&str] = &[
    "PROGRAM ",
    "p",
    "\n",
    "\n",
    "\n",
    " ",
    " ",
    "END_PROGRAM",
    "FUNCTION ",
    "END_FUNCTION",
    "VAR ",
    "VAR_INPUT ",
    "VAR_OUTPUT ",
    "END_VAR",
    "CONSTANT ",
    "RETAIN ",
    "a",
    "b",
    "q",
    " : BOOL;",
    " : BOOL := TRUE;",
    " : INT",
    ":=",
    ":",
    ";",
    ",",
    "LD a\n",
    "ST q\n",
    "LD ",
    "AND ",
    "AND( ",
    "OR(\n",
    ")",
    "(",
    "NOT",
    "JMP ",
    "JMPC a\n",
    "RET\n",
    "a: ",
    "CAL ",
    "%IX0.0",
    "1",
    "TRUE",
    "16#FF",
    "'text'",
    "(*",
    "*)",
    "//",
    "\r",
    "ä",
    "→",
    "\u{feff}",
    "\t",
    "AT ",
    "CONFIGURATION",
    "END_CONFIGURATION",
];
const NET: &[&str] = &[
    "net ", "pl ", "tr ", "pr ", "\n", "\n", " ", " ", "a", "p", "{a=1}", "{", "}", "\\", "->", " -> ", "*2", "?1",
    "?-1", "(1)", "(2)", "[0,w[", ":", "#", "ä", "\r",
];
const PNML: &[&str] = &[
    "<pnml>",
    "</pnml>",
    "<net id='n' type='http://www.pnml.org/version-2009/grammar/ptnet'>",
    "</net>",
    "<page id='g'>",
    "</page>",
    "<place id='p'>",
    "</place>",
    "<place id='q'/>",
    "<transition id='t'/>",
    "<arc id='x' source='p' target='t'/>",
    "<arc id='y' source='t' target='p'/>",
    "<initialMarking><text>1</text></initialMarking>",
    "<name><text>a=1</text></name>",
    "<referencePlace id='r' ref='p'/>",
    "<text>",
    "&amp;",
    "&e;",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "ä",
    "\n",
    "<",
    ">",
    "'",
];
/// Whole elements most of the time, so that some documents are well-formed.
const PROPERTY: &[&str] = &[
    "<property><id>a</id><description>ä</description><formula><place-bound><place>p</place></place-bound></formula></property>",
    "</formula></property><property><id>ö&amp;</id><formula>",
    "<all-paths><globally>",
    "</globally></all-paths>",
    "<exists-path><until><before><true/></before><reach>",
    "</reach></until></exists-path>",
    "<exists-path><next><deadlock/></next></exists-path>",
    "<finally><false/></finally>",
    "<conjunction>",
    "</conjunction>",
    "<implication>",
    "</implication>",
    "<negation>",
    "</negation>",
    "<is-fireable><transition>t</transition><transition> ü </transition></is-fireable>",
    "<integer-le><tokens-count><place>p</place><place>q</place></tokens-count><integer-constant>ä</integer-constant></integer-le>",
    "<integer-eq><integer-sum><integer-constant>1</integer-constant></integer-sum><integer-constant>-1</integer-constant></integer-eq>",
    "<tokens-count><place/></tokens-count>",
    "<place-bound/>",
    "<id x='ä'/>",
    "<![CDATA[ä]]>",
    "<!-- ä -->",
    "&#1;",
    "ä",
    "\n",
    "<",
];

const REQUIREMENT: &[&str] = &[
    "requirement ",
    "r",
    "s",
    ":",
    ";",
    "\n",
    " ",
    " ",
    "\"what\"",
    "\"",
    "AG ",
    "EF ",
    "A [",
    "E[",
    " U ",
    " W ",
    "]",
    "(",
    ")",
    "!",
    "&",
    "|",
    "->",
    "<->",
    "=",
    "<",
    "+",
    "*",
    "-",
    "1",
    "9223372036854775807",
    "a",
    "q",
    "TRUE",
    "at line 1",
    "at idle",
    "marked(\"q=1\")",
    "(*",
    "*)",
    "//",
    "ä",
];

fn soup(words: &'static [&'static str]) -> impl Strategy<Value = String> {
    proptest::collection::vec(proptest::sample::select(words), 0..40).prop_map(|words| words.concat())
}

/// Every label lies in the text, on the boundaries of letters, and the diagnostic can be printed and is not empty.
fn are_printable(diagnostics: &[Diagnostic], source: &Source) -> Result<(), TestCaseError> {
    for diagnostic in diagnostics {
        for label in &diagnostic.labels {
            prop_assert!(source.text().get(label.span.range()).is_some(), "{:?} in {:?}", diagnostic, source.text());
        }
        let (line, column) = source.line_column(diagnostic.span().start);
        let printed = render(diagnostic, source, Style::default());
        let place = format!("--> soup:{line}:{column}\n");
        prop_assert!(printed.contains(&place), "no {} in\n{}", place, printed);
        prop_assert!(!diagnostic.message.is_empty() && !diagnostic.message.contains("Rule::"), "{}", printed);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn of_programs(body in soup(PROGRAM), framed in any::<bool>()) {
        let head = "PROGRAM p\nVAR a, b, q : BOOL; END_VAR\n";
        let source = Source::new("soup", if framed { format!("{head}{body}\nEND_PROGRAM") } else { body });
        let (unit, mut diagnostics) = syntax::parse(&source);
        let (program, more) = semantics::check(&unit, !any_error(&diagnostics));
        diagnostics.extend(more);
        are_printable(&diagnostics, &source)?;
        prop_assert_eq!(program.is_none(), any_error(&diagnostics), "{:?}", diagnostics);
        if let Some(program) = program {
            let system = System::new(flatten(&program), Plant::default());
            prop_assert!(system.net.initial_marking().marked().count() > 0);
        }
    }

    #[test]
    fn of_projects(parts in soup(PROJECT), framed in any::<bool>()) {
        let head = "<project><pou name='p' pouType='program'><interface><localVars><variable name='a'><type><BOOL/></type>\
                    </variable></localVars>";
        let tail = "</interface><body><IL>LD a</IL></body></pou></project>";
        let source = Source::new("soup", if framed { format!("{head}{parts}{tail}") } else { format!("<project>{parts}") });
        let (unit, mut diagnostics) = syntax::parse(&source);
        let (program, more) = semantics::check(&unit, !any_error(&diagnostics));
        diagnostics.extend(more);
        are_printable(&diagnostics, &source)?;
        prop_assert_eq!(program.is_none(), any_error(&diagnostics), "{:?}", diagnostics);
    }

    #[test]
    fn of_nets(text in soup(NET)) {
        let source = Source::new("soup", text);
        if let Err(diagnostics) = tina::read(&source) {
            prop_assert!(any_error(&diagnostics));
            are_printable(&diagnostics, &source)?;
        }
    }

    #[test]
    fn of_pnml(page in soup(PNML), framed in any::<bool>()) {
        let head = "<pnml><net id='n' type='http://www.pnml.org/version-2009/grammar/ptnet'>";
        let source = Source::new("soup", if framed { format!("{head}{page}</net></pnml>") } else { page });
        if let Err(diagnostics) = pnml::read(&source) {
            prop_assert!(any_error(&diagnostics));
            are_printable(&diagnostics, &source)?;
        }
    }

    #[test]
    fn of_properties(formula in soup(PROPERTY), framed in any::<bool>()) {
        let (head, tail) = ("<property-set><property><id>x</id><formula>", "</formula></property></property-set>");
        let source = Source::new("soup", if framed { format!("{head}{formula}{tail}") } else { formula });
        let (properties, diagnostics) = mcc::read(&source);
        are_printable(&diagnostics, &source)?;
        prop_assert!(!properties.is_empty() || any_error(&diagnostics));
        for property in properties {
            if let mcc::Query::Holds(formula) = property.query
                && let Err(diagnostics) = bind_in_net(&formula, &Nodes::by_id([], []))
            {
                prop_assert!(any_error(&diagnostics));
                are_printable(&diagnostics, &source)?;
            }
        }
    }

    #[test]
    fn of_requirements(text in soup(REQUIREMENT), framed in any::<bool>()) {
        let source = Source::new("soup", if framed { format!("requirement r: {text};") } else { text });
        let (file, diagnostics) = parse_requirements(&source);
        are_printable(&diagnostics, &source)?;
        prop_assert!(!file.requirements.is_empty() || !file.domains.is_empty() || any_error(&diagnostics));
        let program = support::program("PROGRAM p VAR a, q : BOOL; END_VAR\nLD a\nST q\nEND_PROGRAM");
        let system = System::new(program, Plant::default());
        for requirement in file.requirements {
            for view in [View::Scan, View::Transition] {
                if let Err(diagnostics) = bind_requirement(&requirement, &system, view) {
                    prop_assert!(any_error(&diagnostics));
                    are_printable(&diagnostics, &source)?;
                }
            }
        }
    }
}
