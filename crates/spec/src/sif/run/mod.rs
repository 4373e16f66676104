//! Execution of test plans by the interpreter: inputs are set, scans executed, and outputs compared with expected
//! values.

mod hunt;
mod model;
mod mutants;

use fixedbitset::FixedBitSet;

use super::binding::{Binder, Located};
use super::{Kind, Plan, SignalId, Specification, Test};
use model::Model;
use petril_check::scans::Failure;
use petril_lang::flat::{FlatProgram, Tolerated};
use petril_lang::interpret::Machine;
use petril_lang::semantics::{Role, VarId};

pub use hunt::{Decide, Fate, Hunt, hunt};
pub use mutants::{Mutant, mutants};

/// Upper bound on the scans of a test: more than five hours at 20 ms.
const MAX_SCANS: u64 = 1 << 20;

/// Initial state of a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Power-on, for each test.
    PowerOn,
    /// Final state of the previous test, as on the real plant: latches keep their values. After an error, power-on.
    Continued,
}

/// Test runner: a program with its variables bound to a specification's signals.
#[derive(Clone, Debug)]
pub struct Runner<'a> {
    specification: &'a Specification,
    program: &'a FlatProgram,
    tolerated: Tolerated,
    start: Start,
    variables: Vec<Option<VarId>>,
}

/// Results of one plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanRun {
    /// Results, one for each test.
    pub tests: Vec<TestRun>,
    /// Outputs touched by the tests that the program does not have: they are not compared.
    pub absent: Vec<SignalId>,
}

/// Result of one test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TestRun {
    /// Number of scans executed.
    pub scans: u64,
    /// Outcome.
    pub ending: Ending,
    /// Outputs that are TRUE at the end, among those compared.
    pub outputs: FixedBitSet,
    /// Outputs whose expected value differs from the one after power-on, because of a latch.
    pub remembered: Vec<SignalId>,
}

/// Outcome of a test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ending {
    /// All outputs have their expected values.
    Passed,
    /// These outputs deviate.
    Failed(Vec<Deviation>),
    /// The last scan failed, so its end is not known.
    Error(Failure),
    /// The test would exceed the limit on scans.
    TooLong,
}

impl Ending {
    /// The outcome in one word: `passed`, `failed` or `error`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Failed(_) => "failed",
            Self::Error(_) | Self::TooLong => "error",
        }
    }
}

/// Output with an unexpected value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Deviation {
    /// Output.
    pub output: SignalId,
    /// Expected value; the actual one was the opposite.
    pub expected: bool,
    /// Scan after which the output deviated (from 1).
    pub scan: u64,
    /// Whether the output became TRUE before its delay had passed.
    pub early: bool,
}

impl<'a> Runner<'a> {
    /// Binds the signals that these plans need to variables.
    ///
    /// # Errors
    /// Signals whose variable is missing or unsuitable.
    pub fn new(
        specification: &'a Specification,
        program: &'a FlatProgram,
        tolerated: Tolerated,
        start: Start,
        plans: &[Plan],
    ) -> Result<Self, Vec<Located>> {
        let mut binder = Binder::new(specification, program);
        let mut seen = FixedBitSet::with_capacity(specification.signals.len());
        let mut left: Vec<SignalId> = Vec::new();
        for plan in plans {
            let own = &specification.functions[plan.function].outputs;
            own.iter().for_each(|&output| _ = binder.bind(output));
            left.extend(own);
        }
        left.reverse();
        while let Some(id) = left.pop() {
            if !seen.put(id.0) {
                if matches!(specification.signal(id).kind, Kind::Input { .. }) {
                    binder.bind(id);
                }
                left.extend(specification.uses(id).into_iter().rev());
            }
        }
        specification.inputs().for_each(|input| _ = binder.bind_if_there(input));
        plans.iter().flat_map(|plan| &plan.touched).for_each(|&output| _ = binder.bind_if_there(output));
        Ok(Self { specification, program, tolerated, start, variables: binder.finish()? })
    }

    /// Specification.
    #[must_use]
    pub fn specification(&self) -> &'a Specification {
        self.specification
    }

    /// Program.
    #[must_use]
    pub fn program(&self) -> &'a FlatProgram {
        self.program
    }

    /// Initial state of each test.
    #[must_use]
    pub fn start(&self) -> Start {
        self.start
    }

    /// Runner of another program with the same variables.
    #[must_use]
    pub fn with<'b>(&self, program: &'b FlatProgram) -> Runner<'b>
    where
        'a: 'b,
    {
        let variables = self.variables.clone();
        Runner { specification: self.specification, program, tolerated: self.tolerated, start: self.start, variables }
    }

    /// The variable of a signal, if the program has it.
    #[must_use]
    pub fn variable(&self, signal: SignalId) -> Option<VarId> {
        self.variables[signal.0]
    }

    /// Inputs of the program bound to no signal. They keep their initial values.
    pub fn unset(&self) -> impl Iterator<Item = VarId> + '_ {
        self.program.with_role(Role::Input).filter(|id| !self.variables.contains(&Some(*id)))
    }

    /// Runs all tests, plan by plan.
    #[must_use]
    pub fn run(&self, plans: &[Plan]) -> Vec<PlanRun> {
        let mut run = Run::new(self);
        plans.iter().map(|plan| run.plan(plan)).collect()
    }

    /// First test that is not passed: position of its plan, and of the test. If each test starts at power-on, plans are
    /// tried from `from` on, and those before it last.
    #[must_use]
    pub fn first_not_passed(&self, plans: &[Plan], from: usize) -> Option<(usize, usize)> {
        let mut run = Run::new(self);
        let from = if self.start == Start::PowerOn { from } else { 0 };
        let plans = plans.iter().enumerate();
        plans.clone().skip(from).chain(plans.take(from)).find_map(|(number, plan)| {
            let scans = run.model.scans(&plan.touched);
            let mut tests = plan.tests.iter();
            tests.position(|test| run.test(plan, test, scans).ending != Ending::Passed).map(|test| (number, test))
        })
    }
}

/// Tests under way: program and reference model side by side.
struct Run<'r> {
    runner: &'r Runner<'r>,
    machine: Machine<'r>,
    model: Model<'r>,
}

impl<'r> Run<'r> {
    fn new(runner: &'r Runner<'r>) -> Self {
        let model = Model::new(runner.specification, runner.program.cycle);
        Self { runner, machine: Machine::new(runner.program), model }
    }

    fn plan(&mut self, plan: &Plan) -> PlanRun {
        let scans = self.model.scans(&plan.touched);
        let absent = plan.touched.iter().copied().filter(|output| self.runner.variable(*output).is_none()).collect();
        PlanRun { tests: plan.tests.iter().map(|test| self.test(plan, test, scans)).collect(), absent }
    }

    fn test(&mut self, plan: &Plan, test: &Test, scans: u64) -> TestRun {
        let Runner { specification, tolerated, ref variables, .. } = *self.runner;
        if self.runner.start == Start::PowerOn {
            self.restart();
        }
        let mut made = TestRun {
            scans: 0,
            ending: Ending::TooLong,
            outputs: FixedBitSet::with_capacity(specification.signals.len()),
            remembered: Vec::new(),
        };
        if scans > MAX_SCANS {
            return made;
        }
        let compared = || plan.touched.iter().filter_map(|&output| Some((output, variables[output.0]?)));
        let mut deviations: Vec<Deviation> = Vec::new();
        for scan in 1..=scans {
            for input in specification.inputs() {
                if let Some(variable) = variables[input.0] {
                    self.machine.set(variable, u64::from(test.values.contains(input.0)));
                }
            }
            let ended = self.machine.scan();
            made.scans = scan;
            let hazard = tolerated.first_error(self.machine.hazards());
            let hazard = hazard.map(|(line, hazard)| Failure::Hazard(line, hazard));
            if let Some(failure) = hazard.or(ended.err().map(Failure::Scan)) {
                made.ending = Ending::Error(failure);
                self.restart();
                return made;
            }
            self.model.scan(&test.values);
            for (output, variable) in compared() {
                let early = scan < scans && is_delayed(specification, output) && !self.model.value(output);
                let known = deviations.iter().any(|deviation| deviation.output == output);
                if early && !known && self.machine.value(variable) == 1 {
                    deviations.push(Deviation { output, expected: false, scan, early });
                }
            }
        }
        let settled = specification.settled(&test.values);
        for (output, variable) in compared() {
            let is = self.machine.value(variable) == 1;
            made.outputs.set(output.0, is);
            let remembers = self.model.value(output) != settled.contains(output.0);
            if remembers {
                made.remembered.push(output);
            }
            let expected = if remembers { self.model.value(output) } else { test.values.contains(output.0) };
            if is != expected {
                deviations.push(Deviation { output, expected, scan: scans, early: false });
            }
        }
        made.ending = if deviations.is_empty() { Ending::Passed } else { Ending::Failed(deviations) };
        made
    }

    fn restart(&mut self) {
        self.machine = Machine::new(self.runner.program);
        self.model.restart();
    }
}

/// Whether an output is delayed.
fn is_delayed(specification: &Specification, output: SignalId) -> bool {
    matches!(specification.signal(output).kind, Kind::Defined { delayed: Some(_), .. })
}
