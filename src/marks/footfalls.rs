//! The stage that turns motion into marks.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::math::{Purpose, Rect, SplitMix64, person_stream};
use crate::motion::{Frame, People, Person, Statures, Walker};
use crate::patterns::{Cause, PatternLibrary};
use crate::walls::Walls;

use super::chairs::Sitting;
use super::contacts::{ContactState, ContactTick, Contacts};
use super::feet::FootPlacement;
use super::gait::GaitState;
use super::heels::{self, HeelMarks};
use super::soil::Shoes;
use super::standing::Standing;
use super::track::{SmoothedPath, TrackSample};
use super::wheels::Wheels;
use super::{Contact, ContactPlaces, Mark, MarksError, MarksOptions, Origin};

/// Limit on frame times, seconds (30 years): the clock of the paths counts ticks of 0.1 s.
const MOST_TIME_S: f64 = 1e9;

/// Turns frames of motion into footfalls, heel marks and contacts; holds only the people who are present.
///
/// Marks come about two seconds of motion after the body passed, ordered by person within a frame and by time within a
/// person. The frames decide which call returns a mark, not the mark itself.
pub struct Footfalls<'a> {
    people: &'a People,
    walls: &'a Walls,
    plan_m: Rect,
    library: &'a PatternLibrary,
    /// Index of the sole that all people wear, if any.
    uniform: Option<u16>,
    options: MarksOptions,
    heel_marks: HeelMarks,
    /// Made at the first frame, unless [`Footfalls::with_contacts`] gave the places; the inner `None` means no contacts.
    contacts: Option<Option<Contacts>>,
    /// Contacts that the caller has not taken yet.
    touched: Vec<Contact>,
    contact_count: u64,
    /// Whiles of standing and lines of wheels that the caller has not taken yet.
    lasting: Vec<Mark>,
    origins: Vec<Origin>,
    /// Number of people of all days.
    crowd: usize,
    /// Body heights that are known; all others are as tall as the people are drawn.
    statures: Statures,
    /// By ascending id.
    #[expect(clippy::vec_box, reason = "they are a kilobyte each and move to a new list at every frame")]
    present: Vec<Box<PresentPerson>>,
    count: u64,
}

/// A person who is present.
struct PresentPerson {
    track: SmoothedPath,
    state: WalkerState,
}

/// What the ticks of a person's path change.
struct WalkerState {
    person: Person,
    gait: GaitState,
    feet: ShoeState,
    contacts: ContactState,
    standing: Standing,
    sitting: Sitting,
    wheels: Option<Box<Wheels>>,
}

/// The shoes of a person and their marks.
struct ShoeState {
    pattern: u16,
    /// Random word of the pair's worn spots.
    wear: u32,
    shoes: Option<Shoes>,
    rng: ChaCha8Rng,
    heels: heels::HeelState,
    /// The foot on the floor.
    last: Option<FootPlacement>,
}

impl<'a> Footfalls<'a> {
    /// Prepares the stage with the doors and corners found in the walls.
    ///
    /// `origins` is indexed by person id; missing people are neither fresh nor from outside.
    ///
    /// # Errors
    /// An option is out of range; the library has no sole, or not the `shoe` of the options.
    ///
    /// # Example
    /// ```
    /// use trodden::marks::{Footfalls, MarksOptions};
    /// use trodden::math::vec2;
    /// use trodden::motion::{Frame, People, Walker};
    /// use trodden::{patterns::PatternLibrary, plan::FloorPlan, walls::Walls};
    ///
    /// // One person walks 6 m to the right.
    /// let plan = FloorPlan::from_mask(100, 40, 0.1, vec![1; 4000]);
    /// let walls = Walls::trace(&plan, &Default::default());
    /// let (people, library) = (People::new(1, Default::default()), PatternLibrary::built_in());
    /// let mut footfalls = Footfalls::new(&people, &walls, &library, &MarksOptions::default(), Vec::new())?;
    /// let mut marks = Vec::new();
    /// for time_s in (0..50).map(|tenth| 0.1 * f64::from(tenth)) {
    ///     let (position_m, velocity_m_s) = (vec2(2.0 + 1.2 * time_s, 2.0), vec2(1.2, 0.0));
    ///     let walkers = vec![Walker { id: 0, position_m, velocity_m_s, heading: None }];
    ///     footfalls.push(&Frame { time_s, walkers }, &mut marks);
    /// }
    /// footfalls.finish(&mut marks);
    /// assert!(marks.len() > 5);
    /// # Ok::<(), trodden::Error>(())
    /// ```
    pub fn new(
        people: &'a People,
        walls: &'a Walls,
        library: &'a PatternLibrary,
        options: &MarksOptions,
        origins: Vec<Origin>,
    ) -> Result<Footfalls<'a>, MarksError> {
        options.check()?;
        if library.pick(Cause::Sole, 0.0, None).is_none() {
            return Err(MarksError::NoSole);
        }
        Ok(Footfalls {
            people,
            walls,
            plan_m: walls.bounds_m(),
            library,
            uniform: options.shoe.as_deref().map(|name| sole_named(library, name)).transpose()?,
            options: options.clone(),
            heel_marks: HeelMarks::new(library, &options.heel, origins.len()),
            crowd: origins.len(),
            contacts: None,
            touched: Vec::new(),
            contact_count: 0,
            lasting: Vec::new(),
            origins,
            statures: Statures::default(),
            present: Vec::new(),
            count: 0,
        })
    }

    /// Says that these people are some of a larger crowd, those of a day: what is rare is drawn more often for a small
    /// crowd.
    pub fn among(mut self, people: usize) -> Footfalls<'a> {
        self.crowd = people;
        self.heel_marks = HeelMarks::new(self.library, &self.options.heel, people);
        self
    }

    /// Replaces the doors, corners and fixtures found in the walls.
    pub fn with_contacts(mut self, places: ContactPlaces) -> Footfalls<'a> {
        self.contacts = Some(Contacts::new(self.walls, self.library, &self.options.contact, self.crowd, || places));
        self
    }

    /// Number of people that the contacts stand for, see [`super::ContactOptions::people`].
    pub fn contact_people(&self) -> u32 {
        let crowd = self.crowd;
        (self.options.contact.rate_factor(crowd) * crowd as f64).round() as u32
    }

    /// Moves the contacts found so far to the end of `out`, in the order of marks.
    pub fn take_contacts(&mut self, out: &mut Vec<Contact>) {
        out.append(&mut self.touched);
    }

    /// Moves the whiles of standing and the lines of wheels found so far to the end of `out`: marks with `stood_s` or
    /// `wheel_m`, in the order of marks.
    pub fn take_lasting(&mut self, out: &mut Vec<Mark>) {
        out.append(&mut self.lasting);
    }

    /// Number of contacts so far.
    pub fn contact_count(&self) -> u64 {
        self.contact_count
    }

    /// Takes the body height of a person who has not appeared yet, metres, where it is known: hands and shoulders touch
    /// walls at heights that follow it, soles and steps are as long. 0.5 to 2.5 m; another one is ignored.
    pub fn know_stature(&mut self, id: u32, stature_m: f64) {
        self.statures.note(id, stature_m);
    }

    /// Takes the next frame and appends the marks found to `out`.
    ///
    /// Walkers must be sorted by id. A person who is missing, or whose position is not finite, has left. Frames without a
    /// finite time are skipped.
    pub fn push(&mut self, frame: &Frame, out: &mut Vec<Mark>) {
        if !frame.time_s.is_finite() || frame.time_s.abs() > MOST_TIME_S {
            return;
        }
        let (walls, library, options, crowd) = (self.walls, self.library, &self.options.contact, self.crowd);
        let of_walls = || Contacts::new(walls, library, options, crowd, || ContactPlaces::of_walls(walls));
        self.contacts.get_or_insert_with(of_walls);
        let mut before = std::mem::take(&mut self.present).into_iter().peekable();
        let mut now = Vec::with_capacity(frame.walkers.len());
        for walker in frame.walkers.iter().filter(|walker| walker.position_m.is_finite()) {
            while let Some(left) = before.next_if(|present| present.state.person.id < walker.id) {
                self.leave(left, out);
            }
            match before.next_if(|present| present.state.person.id == walker.id) {
                Some(mut present) => {
                    self.walk_on(&mut present, frame.time_s, walker, out);
                    now.push(present);
                }
                None => now.push(Box::new(self.arrive(frame.time_s, walker))),
            }
        }
        for left in before {
            self.leave(left, out);
        }
        self.present = now;
    }

    /// Ends the motion; appends the remaining marks to `out`.
    pub fn finish(&mut self, out: &mut Vec<Mark>) {
        for left in std::mem::take(&mut self.present) {
            self.leave(left, out);
        }
    }

    /// Number of footfalls so far.
    pub fn count(&self) -> u64 {
        self.count
    }

    fn arrive(&self, time_s: f64, walker: &Walker) -> PresentPerson {
        let person = self.people.person_of_stature(walker.id, self.statures.of(walker.id));
        let seed = self.people.seed();
        let origin = self.origins.get(walker.id as usize).copied().unwrap_or_default();
        let mut rng = person_stream(seed, person.id, Purpose::Marks);
        let wear = rng.random();
        let heels = heels::HeelState::new(&mut rng);
        let own = || self.library.pick(Cause::Sole, person.shoe_draw, Some(person.sole_length_m * 100.0));
        let feet = ShoeState {
            pattern: self.uniform.or_else(own).unwrap_or(0),
            wear,
            shoes: origin.fresh.then(|| Shoes::new(seed, person.id, &self.options.soil, origin.from_outside)),
            rng,
            heels,
            last: None,
        };
        let gait = GaitState::new(seed, &person, self.options.shifts_per_minute / 60.0);
        let contacts = ContactState::new(seed, &person);
        let (standing, sitting, wheels) = (Standing::default(), Sitting::default(), Wheels::of(seed, &person));
        PresentPerson {
            track: SmoothedPath::new(time_s, walker.position_m, walker.heading),
            state: WalkerState { person, gait, feet, contacts, standing, sitting, wheels },
        }
    }

    fn walk_on(&mut self, present: &mut PresentPerson, time_s: f64, walker: &Walker, out: &mut Vec<Mark>) {
        let PresentPerson { track, state } = present;
        if track.continues(time_s, walker.position_m) {
            track.push(time_s, walker.position_m, walker.heading, |sample| self.advance(state, sample, out));
        } else {
            track.finish(|sample| self.advance(state, sample, out));
            state.gait.interrupt();
            state.contacts.interrupt();
            state.end_lasting(&mut self.lasting);
            *track = SmoothedPath::new(time_s, walker.position_m, walker.heading);
        }
    }

    fn leave(&mut self, mut present: Box<PresentPerson>, out: &mut Vec<Mark>) {
        let PresentPerson { track, state } = &mut *present;
        track.finish(|sample| self.advance(state, sample, out));
        state.end_lasting(&mut self.lasting);
    }

    /// Processes a tick of a smoothed path: footfalls, heel marks, standing, wheels, contacts.
    fn advance(&mut self, state: &mut WalkerState, sample: TrackSample, out: &mut Vec<Mark>) {
        let WalkerState { person, gait, feet, contacts: contact_state, standing, sitting, wheels } = state;
        let progress = gait.walk(person, sample, |step| {
            self.count += 1;
            let inside = self.plan_m.contains(step.place_m);
            out.push(feet.footfall(&step, person.sole_length_m, inside));
            feet.last = Some(step);
        });
        standing.pass(sample.position_m, gait.heading(), progress.stood_s, &mut self.lasting);
        let drags = (feet.wear, self.heel_marks.drags_per_sitting());
        sitting.pass(sample.position_m, progress.stood_s, self.walls, drags, &mut self.lasting);
        if let Some(wheels) = wheels {
            wheels.roll(&sample, gait.heading(), &progress, self.walls, &mut self.lasting);
        }
        if let Some(shoes) = feet.shoes.as_mut().filter(|_| self.plan_m.contains(sample.position_m)) {
            shoes.walk(progress.walked_m);
        }
        let (heels, rng, last, wear) = (&mut feet.heels, &mut feet.rng, feet.last, feet.wear);
        self.heel_marks.walk(heels, rng, &progress, (sample.position_m, self.walls), |rng, turned_rad| {
            let variation = rng.random();
            let mark =
                last.and_then(|foot| self.heel_marks.mark(&foot, person.sole_length_m, turned_rad, wear, variation));
            out.extend(mark);
        });
        if let Some(Some(contacts)) = &self.contacts {
            let tick = ContactTick {
                at_m: sample.position_m,
                facing: gait.heading(),
                velocity_m_s: sample.velocity_m_s,
                walked_m: progress.walked_m,
                stood_s: progress.stood_s,
            };
            let before = self.touched.len();
            contacts.walk(contact_state, self.walls, person, &tick, &mut self.touched);
            // Furniture ends below the hands that reach over it.
            let mut new = self.touched.split_off(before);
            let top_m = |touch: &Contact| self.walls.faces[touch.face as usize].furniture_m.unwrap_or(f64::INFINITY);
            new.retain(|touch| touch.height_m < top_m(touch));
            self.touched.append(&mut new);
            self.contact_count += (self.touched.len() - before) as u64;
        }
    }
}

impl WalkerState {
    /// Ends a while of standing and the lines of wheels; appends them to `out`.
    fn end_lasting(&mut self, out: &mut Vec<Mark>) {
        self.standing.end(out);
        if let Some(wheels) = &mut self.wheels {
            wheels.lift(out);
        }
    }
}

impl ShoeState {
    /// The mark of a footfall. Shoes lose soil from the first step inside the plan on.
    fn footfall(&mut self, step: &FootPlacement, sole_length_m: f64, inside: bool) -> Mark {
        let variation: u64 = self.rng.random();
        let deviation = f64::from(SplitMix64::new(variation ^ u64::from(self.wear)).normal());
        let shoes = self.shoes.as_mut().filter(|_| inside);
        let [soil, wet] = shoes.map_or([0.0; 2], |shoes| shoes.step(step.left, deviation));
        Mark {
            cause: Cause::Sole,
            place_m: step.place_m,
            heading: step.heading,
            mirrored: !step.left,
            pattern: self.pattern,
            length_m: sole_length_m as f32,
            smear_m: step.smear_m as f32,
            twist_rad: step.twist_rad as f32,
            forefoot: step.forefoot as f32,
            effort: step.effort as f32,
            stood_s: 0.0,
            wheel_m: 0.0,
            strength: step.pressure as f32,
            soil: soil as f32,
            wet: wet as f32,
            wear: self.wear,
            variation,
        }
    }
}

fn sole_named(library: &PatternLibrary, name: &str) -> Result<u16, MarksError> {
    let soles = || library.patterns.iter().enumerate().filter(|(_, pattern)| pattern.cause == Cause::Sole);
    let found = soles().find(|(_, pattern)| pattern.name == name).and_then(|(place, _)| u16::try_from(place).ok());
    found.ok_or_else(|| MarksError::UnknownShoe {
        name: name.to_owned(),
        soles: soles().map(|(_, pattern)| pattern.name.clone()).collect(),
    })
}

#[cfg(test)]
mod tests;
