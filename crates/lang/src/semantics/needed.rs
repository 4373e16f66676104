//! Part of a file that one of its units needs. Where a unit is chosen by name, everything else is ignored: a project
//! may hold thousands of declarations, many of what is not modelled, that have nothing to do with it.

use std::collections::BTreeSet;

use crate::syntax::ast::{Name, Unit, VarBlock, VarKind, key};

/// Removes the units, types and global variables that the unit of this name cannot reach. Whatever is named anywhere in
/// a needed declaration counts as needed; so do variables at addresses, which can be used without a name.
pub fn by(unit: &Unit, name: &str) -> Unit {
    let mut words = BTreeSet::from([key(name)]);
    let globals = unit.globals.iter().flat_map(|block| &block.declarations);
    let mut open: Vec<(Vec<String>, bool, String)> = Vec::new();
    open.extend(unit.pous.iter().map(|pou| (vec![pou.name.key()], false, pou.to_string())));
    open.extend(unit.types.iter().map(|declared| (vec![declared.name.key()], false, declared.to_string())));
    open.extend(globals.map(|declaration| {
        let names = declaration.names.iter().map(Name::key).collect();
        (names, declaration.location.is_some(), declaration.to_string())
    }));
    loop {
        let (found, rest): (Vec<_>, Vec<_>) =
            open.into_iter().partition(|(names, located, _)| *located || names.iter().any(|name| words.contains(name)));
        if found.is_empty() {
            break;
        }
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        words.extend(found.iter().flat_map(|(_, _, text)| text.split(|c| !is_part(c))).map(key));
        open = rest;
    }
    let block = |block: &VarBlock| {
        let mut block = block.clone();
        block.declarations.retain(|d| d.location.is_some() || d.names.iter().any(|name| words.contains(&name.key())));
        (!block.declarations.is_empty() || block.kind == VarKind::Access).then_some(block)
    };
    Unit {
        pous: unit.pous.iter().filter(|pou| words.contains(&pou.name.key())).cloned().collect(),
        types: unit.types.iter().filter(|declared| words.contains(&declared.name.key())).cloned().collect(),
        globals: unit.globals.iter().filter_map(block).collect(),
        configurations: unit.configurations.clone(),
    }
}

#[cfg(test)]
mod tests {
    use crate::syntax::parse;
    use petril_base::source::Source;

    #[test]
    fn what_is_needed_is_kept_with_all_it_needs() {
        let text = "TYPE a : INT; b : STRUCT x : c; END_STRUCT; c : a; d : STRING; END_TYPE\n\
            VAR_GLOBAL g : b; h : d; i AT %MW0 : INT; END_VAR\n\
            FUNCTION_BLOCK f VAR_EXTERNAL G : b; END_VAR END_FUNCTION_BLOCK\n\
            FUNCTION_BLOCK e VAR x : d; END_VAR END_FUNCTION_BLOCK\n\
            PROGRAM p VAR x : F; END_VAR END_PROGRAM\nPROGRAM q VAR x : e; END_VAR END_PROGRAM\n";
        let (unit, errors) = parse(&Source::new("x", text));
        assert!(errors.is_empty(), "{errors:?}");
        let kept = super::by(&unit, "P");
        let names: Vec<&str> = kept.pous.iter().map(|pou| pou.name.text.as_str()).collect();
        assert_eq!(names, ["f", "p"]);
        let names: Vec<&str> = kept.types.iter().map(|declared| declared.name.text.as_str()).collect();
        assert_eq!(names, ["a", "b", "c"]);
        let globals = kept.globals.iter().flat_map(|block| &block.declarations);
        let names: Vec<&str> = globals.map(|declaration| declaration.names[0].text.as_str()).collect();
        assert_eq!(names, ["g", "i"]);
    }
}
