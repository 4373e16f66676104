//! Domains of free inputs, written like `level: 0..100` or `k: 0, 3, 7`.

use crate::translate::{Domain, Domains, Plant};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::Role;
use petril_logic::DomainText;

/// Binds a domain, and adds it to those of a program with its plant.
///
/// # Errors
/// The name is not a free input, the values are not of its type, or it already has a domain.
pub fn bind_domain(
    text: &DomainText,
    program: &FlatProgram,
    plant: &Plant,
    domains: &mut Domains,
) -> Result<(), Diagnostic> {
    let DomainText { name, span, ranges } = text;
    let unfit = |message: String| Diagnostic::new(Code::DomainUnfit, *span, message);
    let inputs = || program.with_role(Role::Input).map(|id| program.variable(id).name.as_str());
    let Some(input) = program.named(name) else {
        let message = format!("the program `{}` has no input `{name}`", program.name);
        return Err(Diagnostic::new(Code::RequirementNameUnknown, *span, message).suggest(name, inputs()));
    };
    let variable = program.variable(input);
    if variable.role != Role::Input {
        let message = format!("`{name}` is no input of the program `{}`", program.name);
        return Err(unfit(message).help("the program itself says what the other variables can be"));
    }
    if plant.driver(input).is_some() {
        return Err(unfit(format!("a plant gives `{name}` its values")).help("leave out the domain, or the plant"));
    }
    for &(from, to, place) in ranges {
        let ty = variable.ty;
        if from > to {
            let message = format!("there is no number from {from} to {to}");
            return Err(Diagnostic::new(Code::DomainUnfit, place, message).help("write the smaller one first"));
        }
        let (least, greatest) = program.range(input);
        if let Some(number) = [from, to].into_iter().find(|number| !(least..=greatest).contains(number)) {
            let message = format!("{number} is no value of `{name}`, which is of type `{ty}`");
            let help = format!("`{name}` goes from {least} to {greatest}");
            return Err(Diagnostic::new(Code::DomainUnfit, place, message).help(help));
        }
    }
    let numbers = ranges.iter().map(|&(from, to, _)| (from, to)).collect();
    let Some(domain) = Domain::new(variable.ty, numbers) else {
        return Err(unfit(format!("`{name}` has no values")));
    };
    if domains.insert(input, domain).is_some() {
        return Err(unfit(format!("`{name}` has a domain already")).help("give each input one"));
    }
    Ok(())
}
