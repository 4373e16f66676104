//! What is shown of a session, and what its user is doing.

use petril::flat::FlatProgram;
use petril::logic::View;
use petril::semantics::{Role, VarId};
use petril::simulate::{Breakpoint, Chance, Session, Stopped};
use petril::source::Source;
use petril::verdict::Note;

use crate::cli::input_table;

/// Keys of free inputs. Letters that are left out mean something else.
const LABELS: &str = "123456789abdefghimouvwxyz";

/// A run to a condition takes at most so many scans, of which all values are kept, or so many firings if the condition is about
/// those.
const RUN_SCANS: usize = 10_000;
const RUN_VALUES: usize = 1 << 25;
const RUN_FIRINGS: usize = 100_000;

/// A session with everything its user sees.
pub struct Screen<'s> {
    pub session: Session<'s>,
    pub source: &'s Source,
    chance: Chance<'s>,
    /// The variables in the order in which they are listed: inputs, outputs, memory, constants.
    pub variables: Vec<VarId>,
    /// Free inputs with their keys.
    labels: Vec<(char, VarId)>,
    /// Which variable is chosen, by its position in the list.
    pub chosen: usize,
    pub mode: Mode,
    pub shows_tokens: bool,
    /// What there is to say about the last key, and whether it is a complaint.
    pub message: Option<(String, bool)>,
    /// The condition that was typed last.
    pub condition: String,
    /// What the run shows, where, if it comes from a report.
    notes: Vec<Note>,
}

/// What the user is doing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Going through the run.
    Steps,
    /// Reading what the keys do.
    Help,
    /// Choosing what the plant does; which choice is at hand.
    Plant(usize),
    /// Typing the value of an input.
    Value(VarId, String),
    /// Typing a condition.
    Until(String),
}

impl<'s> Screen<'s> {
    /// The beginning of a session, whose random inputs have a seed.
    pub fn new(session: Session<'s>, source: &'s Source, notes: Vec<Note>, seed: u64) -> Self {
        let system = session.system();
        let roles = [Role::Input, Role::Output, Role::Memory, Role::Constant];
        let variables = roles.into_iter().flat_map(|role| system.program.with_role(role)).collect();
        Self {
            chance: Chance::new(system, seed),
            variables,
            labels: LABELS.chars().zip(system.free_inputs()).collect(),
            chosen: 0,
            mode: Mode::Steps,
            shows_tokens: false,
            message: None,
            condition: String::new(),
            notes,
            session,
            source,
        }
    }

    pub fn program(&self) -> &'s FlatProgram {
        &self.session.system().program
    }

    /// What the run shows at the end of the scan, if it is still the one from the report.
    pub fn note(&self) -> Option<String> {
        let ended = self.session.is_as_planned() && !self.session.is_within();
        let last = self.session.scans().len().checked_sub(1).filter(|_| ended)?;
        let notes = self.notes.iter().filter(|note| (note.first..=note.last).contains(&last));
        let texts: Vec<String> = notes.map(|note| note.sentence(View::Scan)).collect();
        (!texts.is_empty()).then(|| texts.join("; "))
    }

    /// The key of an input, if it has one.
    pub fn label(&self, input: VarId) -> Option<char> {
        self.labels.iter().find(|&&(_, labelled)| labelled == input).map(|&(label, _)| label)
    }

    /// The input of a key.
    pub fn labelled(&self, key: char) -> Option<VarId> {
        self.labels.iter().find(|&&(label, _)| label == key).map(|&(_, input)| input)
    }

    /// Says something.
    pub fn say(&mut self, text: impl Into<String>) {
        self.message = Some((text.into(), false));
    }

    /// Says why something was not done.
    pub fn complain(&mut self, text: impl Into<String>) {
        self.message = Some((text.into(), true));
    }

    /// Does something with the session, and says why it was not done.
    pub fn attempt(&mut self, action: impl FnOnce(&mut Session<'s>) -> Result<(), Stopped>) {
        if let Err(stopped) = action(&mut self.session) {
            self.complain(stopped.to_string());
        } else if let Some(failure) = self.session.failure() {
            self.complain(Stopped::Failed(failure).to_string());
        }
    }

    /// Changes an input: the other truth value, or a number that is asked for.
    pub fn change(&mut self, input: VarId) {
        if self.program().variable(input).ty.is_bool() {
            self.attempt(|session| session.toggle(input));
        } else if let Err(stopped) = self.session.may_set(input) {
            self.complain(stopped.to_string());
        } else {
            self.mode = Mode::Value(input, String::new());
        }
    }

    /// Takes a value that was typed; if it is none, asks again.
    pub fn take_value(&mut self, input: VarId, text: &str) {
        match input_table::value(self.program(), input, text.trim()) {
            Some(value) => self.attempt(|session| session.set(input, value)),
            None => {
                let name = &self.program().variable(input).name;
                self.complain(format!(
                    "`{text}` is no value of `{name}`: {}",
                    input_table::values(self.program(), input)
                ));
                self.mode = Mode::Value(input, text.to_owned());
            }
        }
    }

    /// The next scan by chance.
    pub fn random_scan(&mut self) {
        if self.session.is_within() {
            self.complain(Stopped::UnderWay.to_string());
            return;
        }
        let chance = &mut self.chance;
        let session = &mut self.session;
        let stepped = session.draw_lots(chance).and_then(|()| session.step_scan());
        self.attempt(|_| stepped);
    }

    /// Goes on until the condition is met, with inputs as they are, or by chance where nothing is planned. If it is not met,
    /// nothing was done.
    pub fn run(&mut self, by_chance: bool) {
        if self.condition.trim().is_empty() {
            self.complain("there is no condition yet: type one with /");
            return;
        }
        let text = Source::new("condition", self.condition.as_str());
        let breakpoint = match Breakpoint::read(&text, self.session.system()) {
            Ok(breakpoint) => breakpoint,
            Err(errors) => {
                let words = errors.first().map(|error| {
                    [error.message.clone()]
                        .into_iter()
                        .chain(error.help.first().cloned())
                        .collect::<Vec<_>>()
                        .join("; ")
                });
                self.complain(words.unwrap_or_default());
                self.mode = Mode::Until(self.condition.clone());
                return;
            }
        };
        let (limit, unit) = match breakpoint {
            Breakpoint::Scans(_) => (RUN_SCANS.min(1 + RUN_VALUES / self.program().variables.len().max(1)), "scans"),
            Breakpoint::Firings(_) => (RUN_FIRINGS, "firings"),
        };
        let begun = self.session.clone();
        let chance = by_chance.then_some(&mut self.chance);
        match self.session.run_until(&breakpoint, limit, chance) {
            Ok(true) => self.say(format!("`{}` is true", self.condition)),
            Ok(false) => {
                self.session = begun;
                self.complain(format!("`{}` would be true after none of {limit} {unit}", self.condition));
            }
            Err(stopped) => self.complain(stopped.to_string()),
        }
    }
}
