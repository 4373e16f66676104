//! Values of a type that a faulty function returns, as `cargo mutants` chooses them.

use syn::{GenericArgument, PathArguments, ReturnType, Type};

/// Expressions to return at once; none where no value of the type can be named.
pub fn of_return(output: &ReturnType) -> Vec<String> {
    match output {
        ReturnType::Default => vec![String::new()],
        ReturnType::Type(_, given) => of_type(given),
    }
}

fn of_type(given: &Type) -> Vec<String> {
    let each = |inner: &Type, wrap: &dyn Fn(&str) -> String| of_type(inner).iter().map(|value| wrap(value)).collect();
    match given {
        Type::Tuple(tuple) if tuple.elems.is_empty() => vec!["()".to_owned()],
        Type::Tuple(tuple) => {
            // One component faulty at a time, the others by default.
            let first = |part: &Type| of_type(part).first().cloned();
            let Some(usual) = tuple.elems.iter().map(first).collect::<Option<Vec<_>>>() else { return Vec::new() };
            vec![format!("({},)", usual.join(", "))]
        }
        Type::Reference(reference) => match &*reference.elem {
            Type::Path(path) if path.path.is_ident("str") => vec!["\"\"".to_owned(), "\"xyzzy\"".to_owned()],
            Type::Slice(_) => vec!["&mut []".to_owned()],
            inner => each(inner, &|value| format!("Box::leak(Box::new({value}))")),
        },
        Type::Path(path) => {
            let Some(last) = path.path.segments.last() else { return Vec::new() };
            let inner = match &last.arguments {
                PathArguments::AngleBracketed(arguments) => arguments.args.first(),
                _ => None,
            };
            let inner =
                inner.and_then(|argument| if let GenericArgument::Type(inner) = argument { Some(inner) } else { None });
            named(&last.ident.to_string(), inner)
        }
        _ => Vec::new(),
    }
}

fn named(name: &str, inner: Option<&Type>) -> Vec<String> {
    let wrapped =
        |before: &str| inner.map_or_else(Vec::new, of_type).iter().map(|value| format!("{before}({value})")).collect();
    let texts = |values: &[&str]| values.iter().map(|&value| value.to_owned()).collect::<Vec<_>>();
    match name {
        "bool" => texts(&["true", "false"]),
        "u8" | "u16" | "u32" | "u64" | "u128" | "usize" => texts(&["0", "1"]),
        "i8" | "i16" | "i32" | "i64" | "i128" | "isize" => texts(&["0", "1", "-1"]),
        "f32" | "f64" => texts(&["0.0", "1.0", "-1.0"]),
        "String" => texts(&["String::new()", "\"xyzzy\".into()"]),
        "Option" => texts(&["None"]).into_iter().chain::<Vec<_>>(wrapped("Some")).collect(),
        "Result" if inner.is_none() => texts(&["Ok(Default::default())"]),
        "Result" => wrapped("Ok"),
        "Box" | "Arc" | "Rc" => wrapped(&format!("{name}::new")),
        "Vec" => {
            let filled = inner.map_or_else(Vec::new, of_type);
            texts(&["Vec::new()"]).into_iter().chain(filled.iter().map(|value| format!("vec![{value}]"))).collect()
        }
        _ => texts(&["Default::default()"]),
    }
}
