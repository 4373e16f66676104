//! A check from texts to a report: everything is bound inside, to one system in one view.

use petril_base::diagnostic::{Diagnostic, any_error};
use petril_base::source::Source;
use petril_lang::flat::{Tolerated, flatten};
use petril_lang::{semantics, syntax};
use petril_logic::{Requirement, View, parse_requirement};
use petril_net::net::Located;
use petril_search::{Budget, Progress};

use crate::requirement::{Demand, bind_requirement};
use crate::translate::{Plant, System};
use crate::verdict::{Options, Report, check};

/// A program in its plants, and what is required of it.
#[derive(Clone, Debug)]
pub struct Check {
    system: System,
    requirements: Vec<(Requirement, Demand)>,
    options: Options,
    warnings: Vec<Diagnostic>,
}

impl Check {
    /// Reads a program. Its inputs have any value in any scan; a state is the end of a scan.
    ///
    /// # Errors
    /// Everything that is wrong with the text.
    pub fn of(program: &Source) -> Result<Self, Vec<Diagnostic>> {
        Self::in_plants(program, &[], View::Scan)
    }

    /// Reads a program that stands in plants, to be checked in a view.
    ///
    /// # Errors
    /// Everything that is wrong with the text, or with the first plant that does not fit the program.
    pub fn in_plants(program: &Source, plants: &[Located], view: View) -> Result<Self, Vec<Diagnostic>> {
        let (unit, mut warnings) = syntax::parse(program);
        let (checked, found) = semantics::check(&unit, !any_error(&warnings));
        warnings.extend(found);
        let Some(checked) = checked.filter(|_| !any_error(&warnings)) else { return Err(warnings) };
        let program = flatten(&checked);
        let mut plant = Plant::default();
        for net in plants {
            warnings.extend(plant.add(net, &program)?);
        }
        let system = System::new(program, plant);
        Ok(Self { system, requirements: Vec::new(), options: Options { view, ..Options::default() }, warnings })
    }

    /// Adds a requirement: a formula, a pattern or a sentence.
    ///
    /// # Errors
    /// Everything that is wrong with the text, and names that the program does not have in the view.
    pub fn require(mut self, name: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let requirement = parse_requirement(name, &Source::new(name, text)).map_err(|error| vec![error])?;
        self.warnings.extend(requirement.doubt(self.options.view));
        let demand = bind_requirement(&requirement, &self.system, self.options.view)?;
        self.requirements.push((requirement, demand));
        Ok(self)
    }

    /// Limits the exploration.
    #[must_use]
    pub fn within(mut self, budget: Budget) -> Self {
        self.options.budget = budget;
        self
    }

    /// Goes on after some hazards, as [`Tolerated`] says.
    #[must_use]
    pub fn tolerating(mut self, tolerated: Tolerated) -> Self {
        self.options.tolerated = tolerated;
        self
    }

    /// Warnings about the program, its plants and its requirements.
    #[must_use]
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }

    /// The system that is checked.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Explores the system and decides the requirements. `watch` is called now and then, and may give a reason to stop.
    #[must_use]
    pub fn run(&self, watch: &mut dyn FnMut(&Progress) -> Option<String>) -> Report {
        check(&self.system, &self.requirements, &self.options, watch)
    }
}
