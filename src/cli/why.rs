use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use trodden::bake::{Reason, WallHere, Why, why};
use trodden::math::{Vec2, vec2};

use super::arguments::number_within;
use super::{Common, print};

/// Say what made a place of a finished bake as it is: passes, causes, routes, what is near
///
/// Causes are told by what the floor would lack without each of them, as optical density D: dirt covers with 1 - exp(-D).
/// Routes are those whose way leads over the place. A wall nearby is told of too.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden why out/station --at 12.5,3
  trodden why out/station --at 12.5,3 --within 1 --json | jq '.floor[0].cause'

A place is x,y in metres from the plan's lower left corner, as `view` prints it and paths.png shows it.")]
pub struct WhyCommand {
    /// The folder that a bake left
    #[arg(value_name = "BAKE")]
    bake: PathBuf,
    /// The place: x,y in metres of the plan
    #[arg(long, value_name = "X,Y", value_parser = place, allow_hyphen_values = true)]
    at: Vec2,
    /// How far around it, in metres, 0.01 to 2
    #[arg(long, value_name = "M", default_value = "0.25", value_parser = within, allow_negative_numbers = true)]
    within: f64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl WhyCommand {
    pub fn run(&self, _: &Common) -> anyhow::Result<ExitCode> {
        let found = why(&self.bake, self.at, self.within)?;
        if self.json {
            print::line(serde_json::to_string_pretty(&found)?)?;
        } else {
            tell(&found)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn tell(why: &Why) -> anyhow::Result<()> {
    let Why { at_m, within_m, people, total_passes, passes, .. } = why;
    print::line(format!("[{:.2}, {:.2}] and {within_m} m around it", at_m.x, at_m.y))?;
    print::line(format!(
        "{passes:.0} passes over a spot, by {total_passes} people: the {people} of the bake stand for them"
    ))?;
    sums("sums of those", &why.sums)?;
    reasons("floor", &why.floor)?;
    if !why.routes.is_empty() {
        print::line("routes, by who comes by:")?;
    }
    for route in &why.routes {
        print::line(format!("  {:3.0} %  {}, {:.0} people", 100.0 * route.share, route.name, route.people))?;
    }
    for (what, distance_m) in &why.near {
        print::line(format!("near: {what}, {distance_m:.2} m"))?;
    }
    let Some(WallHere { face, along_m, distance_m, sums: touches, wall, .. }) = &why.wall else { return Ok(()) };
    print::line(format!("near: wall {face} at {along_m:.2} m of its length, {distance_m:.2} m"))?;
    sums("touches of the people of the bake", touches)?;
    reasons("wall", wall)
}

fn sums(of: &str, sums: &BTreeMap<&str, f64>) -> anyhow::Result<()> {
    let each: Vec<String> = sums.iter().map(|(name, mean)| format!("{name} {mean:.4}")).collect();
    print::line(format!("{of}: {}", if each.is_empty() { "none".to_string() } else { each.join(", ") }))
}

fn reasons(of: &str, reasons: &[Reason]) -> anyhow::Result<()> {
    let all: f64 = reasons.iter().map(|reason| reason.density).sum();
    if reasons.is_empty() {
        return print::line(format!("{of}: clean"));
    }
    print::line(format!("{of}: optical density {all:.3}, by cause:"))?;
    for Reason { cause, density, share } in reasons {
        print::line(format!("  {:3.0} %  {cause}, {density:.3}", 100.0 * share))?;
    }
    Ok(())
}

fn place(text: &str) -> Result<Vec2, String> {
    let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    let numbers = text.split_once(',').and_then(|(x, y)| Some(vec2(number(x)?, number(y)?)));
    numbers.ok_or_else(|| "two numbers with a comma between them, metres, such as 12.5,3".to_string())
}

fn within(text: &str) -> Result<f64, String> {
    number_within(text, [0.01, 2.0])
}
