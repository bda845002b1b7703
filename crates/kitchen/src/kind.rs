//! The kinds of things in a room and what sets them apart.

/// The agent's type.
pub(crate) const AGENT: &str = "agent";

/// What a tool does to food.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Process {
    Cut,
    Blend,
    Toast,
}

/// What stands in a cell and cannot be moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StationKind {
    Counter,
    Cutboard,
    Breadslicer,
    Machete,
    Blender,
    Toaster,
    Contactgrill,
}

impl StationKind {
    pub(crate) const TOOLS: [Self; 6] =
        [Self::Cutboard, Self::Breadslicer, Self::Machete, Self::Blender, Self::Toaster, Self::Contactgrill];

    pub(crate) const ALL: [Self; 7] = [
        Self::Counter,
        Self::Cutboard,
        Self::Breadslicer,
        Self::Machete,
        Self::Blender,
        Self::Toaster,
        Self::Contactgrill,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Counter => "counter",
            Self::Cutboard => "cutboard",
            Self::Breadslicer => "breadslicer",
            Self::Machete => "machete",
            Self::Blender => "blender",
            Self::Toaster => "toaster",
            Self::Contactgrill => "contactgrill",
        }
    }

    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// What it does to food; nothing for a counter.
    pub(crate) fn process(self) -> Option<Process> {
        match self {
            Self::Counter => None,
            Self::Cutboard | Self::Breadslicer | Self::Machete => Some(Process::Cut),
            Self::Blender => Some(Process::Blend),
            Self::Toaster | Self::Contactgrill => Some(Process::Toast),
        }
    }

    /// The number of items it has room for.
    pub(crate) fn capacity(self) -> usize {
        match self {
            Self::Toaster | Self::Contactgrill => 2,
            _ => 1,
        }
    }

    /// Whether it gets through a hard shell.
    pub(crate) fn cuts_hard_shells(self) -> bool {
        self == Self::Machete
    }
}

/// What can be carried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ItemKind {
    Plate,
    Lettuce,
    Tomato,
    Onion,
    Carrot,
    Cucumber,
    Hokkaido,
    Banana,
    Apple,
    Watermelon,
    Coconut,
    Bread,
    Bagel,
}

impl ItemKind {
    pub(crate) const ALL: [Self; 13] = [
        Self::Plate,
        Self::Lettuce,
        Self::Tomato,
        Self::Onion,
        Self::Carrot,
        Self::Cucumber,
        Self::Hokkaido,
        Self::Banana,
        Self::Apple,
        Self::Watermelon,
        Self::Coconut,
        Self::Bread,
        Self::Bagel,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Plate => "plate",
            Self::Lettuce => "lettuce",
            Self::Tomato => "tomato",
            Self::Onion => "onion",
            Self::Carrot => "carrot",
            Self::Cucumber => "cucumber",
            Self::Hokkaido => "hokkaido",
            Self::Banana => "banana",
            Self::Apple => "apple",
            Self::Watermelon => "watermelon",
            Self::Coconut => "coconut",
            Self::Bread => "bread",
            Self::Bagel => "bagel",
        }
    }

    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    pub(crate) fn is_food(self) -> bool {
        self != Self::Plate
    }

    /// Whether it has a `blend_state`.
    pub(crate) fn can_be_blended(self) -> bool {
        matches!(self, Self::Carrot | Self::Banana | Self::Apple)
    }

    /// Whether it has a `toast_state`.
    pub(crate) fn can_be_toasted(self) -> bool {
        matches!(self, Self::Bread | Self::Bagel)
    }

    /// Whether only a machete gets through it.
    pub(crate) fn has_hard_shell(self) -> bool {
        matches!(self, Self::Coconut | Self::Hokkaido)
    }

    /// The number of items it has room for: a plate takes as good as anything.
    pub(crate) fn capacity(self) -> usize {
        if self.is_food() { 0 } else { 64 }
    }
}
