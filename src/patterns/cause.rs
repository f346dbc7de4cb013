//! Causes of marks, and the forms of stains that they leave.

/// The cause of a mark: the part of a body, the shoe or the luggage that leaves it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// A shoe sole set down: the footprint.
    Sole,
    /// A heel or toe dragged over the floor: the thin black mark.
    Heel,
    /// A hand on a wall: palm, dragged fingers, fingertips.
    Hand,
    /// A forearm or an elbow along a wall.
    Arm,
    /// A shoulder or an upper arm against a wall.
    Shoulder,
    /// A bag, a case or a trolley against a wall.
    Bag,
    /// A shoe against the foot of a wall.
    Shoe,
}

impl Cause {
    /// Every cause, in the order of lists.
    pub const ALL: [Cause; 7] =
        [Cause::Sole, Cause::Heel, Cause::Hand, Cause::Arm, Cause::Shoulder, Cause::Bag, Cause::Shoe];
    /// The causes that mark walls; each has its own sums.
    pub const WALL: [Cause; 5] = [Cause::Hand, Cause::Arm, Cause::Shoulder, Cause::Bag, Cause::Shoe];

    /// The cause as `patterns.toml` writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Cause::Sole => "sole",
            Cause::Heel => "heel",
            Cause::Hand => "hand",
            Cause::Arm => "arm",
            Cause::Shoulder => "shoulder",
            Cause::Bag => "bag",
            Cause::Shoe => "shoe",
        }
    }

    /// Index in [`Cause::WALL`]; `None` for the causes that mark the floor.
    pub const fn on_wall(self) -> Option<usize> {
        match self {
            Cause::Sole | Cause::Heel => None,
            Cause::Hand => Some(0),
            Cause::Arm => Some(1),
            Cause::Shoulder => Some(2),
            Cause::Bag => Some(3),
            Cause::Shoe => Some(4),
        }
    }

    /// Range of the real length of a pattern of this cause, centimetres.
    pub(crate) const fn lengths_cm(self) -> [f64; 2] {
        match self {
            Cause::Sole => [8.0, 45.0],
            Cause::Heel => [1.0, 30.0],
            Cause::Hand | Cause::Arm | Cause::Shoulder | Cause::Bag | Cause::Shoe => [0.5, 150.0],
        }
    }

    /// Range of breadth over length of a pattern of this cause.
    ///
    /// Floor patterns are drawn along their length; wall patterns are upright and may be higher than long.
    pub(crate) const fn aspects(self) -> [f64; 2] {
        if self.on_wall().is_some() { [0.01, 4.0] } else { [0.01, 1.0] }
    }
}

/// The kind of stain that a pattern shows, for causes that leave several kinds.
///
/// A contact chooses its pattern by cause and form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Hand: laid flat to push or lean; mostly a soft cloud.
    Palm,
    /// Hand: fingers dragged along the wall, the drag to the right.
    Drag,
    /// Hand: the tips of the fingers.
    Fingertips,
    /// Shoe: the toe scuffs the wall.
    Toe,
    /// Shoe: a heel drawn along the wall: a thin line.
    HeelLine,
    /// Shoe: a sole set against the wall.
    Sole,
}

impl Form {
    /// Every form, in the order of lists.
    pub const ALL: [Form; 6] = [Form::Palm, Form::Drag, Form::Fingertips, Form::Toe, Form::HeelLine, Form::Sole];

    /// The form as `patterns.toml` writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Form::Palm => "palm",
            Form::Drag => "drag",
            Form::Fingertips => "fingertips",
            Form::Toe => "toe",
            Form::HeelLine => "heel_line",
            Form::Sole => "sole",
        }
    }

    /// The cause of stains of this form.
    pub const fn cause(self) -> Cause {
        match self {
            Form::Palm | Form::Drag | Form::Fingertips => Cause::Hand,
            Form::Toe | Form::HeelLine | Form::Sole => Cause::Shoe,
        }
    }

    /// Lists the forms of a cause for messages: `"palm", "drag" or "fingertips"`, or `none`.
    pub(crate) fn of_cause_in_words(cause: Cause) -> String {
        let forms = Form::ALL.into_iter().filter(|form| form.cause() == cause);
        let names: Vec<String> = forms.map(|form| format!("\"{}\"", form.name())).collect();
        match names.split_last() {
            Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
            Some((only, _)) => only.clone(),
            None => "none".to_owned(),
        }
    }
}
