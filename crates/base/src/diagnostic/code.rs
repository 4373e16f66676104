//! The table of problems Petril knows: one code each, never reused.

use std::fmt;

/// Severity: whether a problem stops the work or is only worth knowing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The text cannot be used as it is.
    Error,
    /// The text can be used, but probably does not say what was meant.
    Warning,
}

macro_rules! codes {
    ($($(#[doc = $summary:literal])+ $name:ident = $id:literal,)+) => {
        /// A known problem. The hundreds of its number say where it is found: 01 syntax, 02 declarations and names, 03
        /// instructions, 04 nets and plants, 05 requirements, 06 input tables, 07 the letter of the standard,
        /// which is asked for with `--strict`, 08 project files, 09 specifications of safety functions.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code { $($(#[doc = $summary])+ $name,)+ }

        impl Code {
            /// Every code, in the order of the table.
            pub const ALL: &'static [Code] = &[$(Code::$name),+];

            /// Printed form of the code, like `E0201`.
            #[must_use]
            pub fn id(self) -> &'static str {
                match self { $(Code::$name => $id),+ }
            }

            /// Summary of the problem in one sentence.
            #[must_use]
            pub fn summary(self) -> &'static str {
                match self { $(Code::$name => concat!($($summary),+).trim_ascii()),+ }
            }
        }
    };
}

codes! {
    /// The file is binary, or in an encoding that holds NUL bytes.
    NotText = "E0101",
    /// The text is not what the grammar expects at this place.
    Syntax = "E0102",
    /// A comment is opened and never closed.
    CommentNotClosed = "E0103",
    /// A parenthesis is opened and never closed.
    ParenthesisNotClosed = "E0104",
    /// A closing parenthesis has no opening one.
    ParenthesisNotOpened = "E0105",
    /// Parentheses are nested too deeply.
    ParenthesisTooDeep = "E0106",
    /// A program organisation unit or a declaration block has no end.
    EndMissing = "E0107",
    /// The file declares nothing that can be run.
    NothingToCheck = "E0108",
    /// The first word of an instruction is neither an operator nor a known function.
    UnknownOperator = "E0109",
    /// The file is too large to be taken in.
    FileTooLarge = "E0110",
    /// The file declares several programs.
    SeveralPrograms = "E0111",
    /// A project in XML is not what its format asks for.
    XmlSyntax = "E0112",
    /// A declaration is nested too deeply.
    DeclarationTooDeep = "E0113",
    /// The text is Siemens Statement List (STL, AWL).
    StatementList = "E0114",

    /// A name is declared twice.
    NameDeclaredTwice = "E0201",
    /// A name is used and not declared.
    NameNotDeclared = "E0202",
    /// A data type is not supported.
    TypeNotSupported = "E0203",
    /// An initial value does not fit the type.
    InitialValueUnfit = "E0204",
    /// A kind of declaration is not supported.
    DeclarationNotSupported = "E0205",
    /// A constant has no initial value.
    ConstantWithoutValue = "W0206",
    /// A program organisation unit is not part of what is checked.
    PouNotChecked = "W0207",
    /// A type is used and not declared.
    TypeNotDeclared = "E0208",
    /// A type contains itself.
    TypeRecursive = "E0209",
    /// A range is empty, or its ends are no numbers.
    RangeUnfit = "E0210",
    /// A variable has too many elements to be modelled.
    VariableTooLarge = "E0211",
    /// An address is none, or does not fit its variable.
    AddressUnfit = "E0212",
    /// Two variables share an address.
    AddressShared = "E0213",
    /// An external variable has no global one behind it.
    ExternalWithoutGlobal = "E0214",
    /// Two program organisation units or types have the same name.
    PouDeclaredTwice = "E0215",
    /// A program organisation unit calls itself.
    Recursion = "E0216",
    /// A function has no result, or one that cannot be returned.
    FunctionResult = "E0217",
    /// Retained variables are modelled as after a cold start only.
    RetainColdStart = "W0218",
    /// A task says nothing that can be used of how often it runs.
    TaskUnfit = "E0219",
    /// A program organisation unit that is called is not written in IL.
    OtherLanguage = "E0220",
    /// There is no program, so a function block or function is checked by itself.
    CheckedByItself = "W0221",
    /// A variable is never used.
    VariableNotUsed = "W0222",
    /// A variable is read and never written.
    VariableNotWritten = "W0223",
    /// An output is never written.
    OutputNotWritten = "W0224",
    /// An instance of a function block stands where it cannot keep its state.
    InstanceUnfit = "E0225",
    /// An in-out variable has no caller whose variable it could stand for.
    InOutWithoutCaller = "E0226",
    /// Two addresses are one place on some controllers.
    AddressesMayOverlap = "W0227",

    /// An operand is missing, or stands where none belongs.
    OperandCount = "E0302",
    /// An operand is not of a kind the operator takes.
    OperandUnfit = "E0303",
    /// An input of the program is written.
    InputWritten = "E0304",
    /// A constant is written.
    ConstantWritten = "E0305",
    /// A jump goes to a label that does not exist.
    LabelNotDefined = "E0306",
    /// A label is defined twice.
    LabelDefinedTwice = "E0307",
    /// A label, jump, return or call stands inside parentheses.
    ControlInsideParentheses = "E0308",
    /// The current result is used where it may not have a value.
    ResultUndefined = "E0309",
    /// A parenthesis does not begin with a value.
    ParenthesisWithoutValue = "E0310",
    /// An instruction can never be executed.
    InstructionUnreachable = "W0311",
    /// A label is never jumped to.
    LabelNotUsed = "W0312",
    /// Types differ where they have to be the same.
    TypesDiffer = "E0313",
    /// A literal is no value of the type it is used with.
    LiteralUnfit = "E0314",
    /// An operator has no meaning for a type.
    OperatorUnfit = "E0315",
    /// A variable has no such member.
    MemberUnknown = "E0316",
    /// A variable is not an array of so many dimensions.
    IndexCount = "E0317",
    /// An index is outside its array.
    IndexOutside = "E0318",
    /// An index is not of a kind that can choose an element.
    IndexUnfit = "E0319",
    /// What is called is no instance of a function block.
    NotCallable = "E0320",
    /// A call names a parameter that does not exist.
    ParameterUnknown = "E0321",
    /// A call gives a parameter twice.
    ParameterTwice = "E0322",
    /// A call leaves out what it has to give, or gives too much.
    ParameterCount = "E0323",
    /// A parameter is not of a kind that can be given so.
    ParameterUnfit = "E0324",
    /// A member of a function block is used from outside in a way it cannot be.
    MemberHidden = "E0325",
    /// The current result has another type on another way to this instruction.
    ResultTypesDiffer = "E0326",
    /// A value is computed and never used.
    ResultNotUsed = "W0327",
    /// A jump goes back, so that a scan may never end.
    JumpBack = "W0328",
    /// A standard function or function block is not supported.
    StandardNotSupported = "E0329",
    /// The program is too large when all its calls are written out.
    ProgramTooLarge = "E0330",
    /// Nothing says of which type a literal is, and that makes a difference.
    LiteralWithoutType = "W0331",

    /// A net file is not what its format asks for.
    NetSyntax = "E0401",
    /// A net uses something that safe place/transition nets do not have.
    NetNotOrdinary = "E0402",
    /// A node of a net is defined twice or refers to nothing.
    NetReference = "E0403",
    /// A plant drives or reads a variable the program does not have.
    PlantVariableUnknown = "E0404",
    /// A plant place names a variable that a plant cannot drive or read.
    PlantVariableUnfit = "E0405",
    /// A plant is not safe: a place can get a second token.
    PlantNotSafe = "E0406",
    /// An input has no value, or several, in some marking of the plant.
    PlantInputAmbiguous = "E0407",
    /// A plant writes a variable of the program.
    PlantWritesProgram = "E0408",
    /// Two plants have the same name.
    PlantNameTwice = "E0409",
    /// A component of a plant has too many markings to be taken in.
    PlantTooLarge = "E0410",
    /// The units of a net do not fit it.
    UnitsUnfit = "W0411",
    /// Two places of a plant stand for one valuation.
    PlantValuationTwice = "E0412",
    /// A transition of a plant can never fire.
    PlantTransitionDead = "W0413",
    /// A place of a plant is not declared, and nothing leaves it.
    PlantPlaceUndeclared = "W0414",

    /// A requirement is not what the grammar expects.
    RequirementSyntax = "E0501",
    /// A requirement names something that does not exist.
    RequirementNameUnknown = "E0502",
    /// Truth values and numbers are mixed where they cannot be.
    RequirementTypes = "E0503",
    /// Two requirements have the same name.
    RequirementNameTwice = "E0504",
    /// A requirement asks for something this view of the system does not have.
    RequirementView = "E0505",
    /// A domain does not fit what it is for.
    DomainUnfit = "E0506",
    /// An assumption speaks of what cannot be assumed.
    AssumptionUnfit = "E0507",
    /// An assertion stands where it cannot be checked.
    AssertionUnfit = "E0508",
    /// A fairness assumption does not fit what it is about.
    FairnessUnfit = "E0510",
    /// A formula of LTL has a part that cannot stand in it.
    LtlUnfit = "E0511",
    /// A formula speaks of the beginning of a run only.
    FormulaOfBeginning = "W0512",
    /// A property of PLCverif asks for something else than its description, or for nothing that is checked here.
    PropertyDoubtful = "W0514",

    /// A table of inputs is not what the program needs.
    InputTable = "E0601",

    /// By the letter of edition 2, a comment does not run to the end of its line.
    StrictLineComment = "E0701",
    /// By the letter of edition 2, comments do not nest.
    StrictNestedComment = "E0702",
    /// By the letter of edition 2, an instruction does not end with `;`.
    StrictSemicolon = "E0703",
    /// By the letter of edition 2, each parameter of a formal call stands on a line of its own.
    StrictFormalCall = "E0704",
    /// By the letter of edition 2, an operator is no name of a variable.
    StrictOperatorName = "E0705",
    /// By the letter of edition 2, a closing parenthesis stands on a line of its own.
    StrictClosing = "E0706",
    /// By the letter of edition 2, a global variable is declared where it is used.
    StrictGlobal = "E0707",
    /// By the letter of edition 2, an address without a size is that of one bit.
    StrictAddressSize = "E0708",
    /// By the letter of edition 2, only a program is executed.
    StrictNoProgram = "E0709",

    /// A project file is not in TOML.
    ProjectSyntax = "E0801",
    /// A key means nothing where it stands in a project file.
    ProjectKey = "E0802",
    /// A value is not what its key in a project file takes.
    ProjectValue = "E0803",
    /// An entry of a project has no program to check.
    ProjectProgram = "E0804",
    /// Two entries of a project have the same name.
    ProjectName = "E0805",

    /// A specification of safety functions is not what its grammar expects.
    SifSyntax = "E0901",
    /// A restriction does not say whether its formula is never or always so.
    SifPolarity = "E0902",
    /// A formula names a signal that does not exist, or cannot be named there.
    SifNameUnknown = "E0903",
    /// Two things of a specification have the same name.
    SifNameTwice = "E0904",
    /// A signal is declared in two ways that do not go together.
    SifDeclaredDifferently = "E0905",
    /// An output has no equation, or a function no output.
    SifNotDefined = "E0906",
    /// An equation defines what is no output or auxiliary value of its function.
    SifNotDefinable = "E0907",
    /// A value is defined by way of itself.
    SifCycle = "E0908",
    /// A signal stands for a variable that the program does not have.
    SifVariableUnknown = "E0911",
    /// A signal stands for a variable of another kind.
    SifVariableUnfit = "E0912",
    /// Two signals stand for one variable.
    SifVariableShared = "E0913",
    /// No equation uses an input.
    SifInputNotUsed = "W0920",
    /// An input makes no difference to any output.
    SifInputWithoutEffect = "W0921",
    /// A function lists an input and does not use it.
    SifInputListed = "W0922",
    /// A function uses a signal and does not list it.
    SifInputNotListed = "W0923",
    /// An output is always the same.
    SifConstant = "W0924",
    /// Restrictions contradict each other.
    SifContradiction = "W0925",
    /// A restriction excludes nothing that others do not.
    SifImplied = "W0926",
    /// A restriction has nothing to do with what it is about.
    SifApart = "W0927",
    /// Restrictions remove every test of a cause.
    SifCauseRemoved = "W0928",
    /// A literal never decides an output because of restrictions.
    SifNeverDecides = "W0929",
    /// Two outputs are always the same, or always opposites.
    SifSame = "W0930",
    /// A latched output is never reset.
    SifResetNever = "W0931",
    /// A question about a specification could not be decided.
    SifNotDecided = "W0932",
}

impl Code {
    /// Severity of the problem, by the letter of its code.
    #[must_use]
    pub fn severity(self) -> Severity {
        if self.id().starts_with('W') { Severity::Warning } else { Severity::Error }
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

#[cfg(test)]
mod tests {
    use super::Code;

    #[test]
    fn ids_are_unique_and_in_order_within_their_hundred() {
        let numbers: Vec<&str> = Code::ALL.iter().map(|code| &code.id()[1..]).collect();
        assert!(numbers.is_sorted_by(|a, b| a < b), "{numbers:?}");
    }
}
