//! Furniture, door leaves and windows as prisms.

use super::builder::{MeshBuilder, MeshVertex, SceneBuilder};
use super::model::SceneSurface;
use super::tops::add_upright;
use crate::math::Vec2;
use crate::show::rooms::Fittings;

/// Adds all fittings by material.
pub(super) fn add(fittings: &Fittings, scene: &mut SceneBuilder) {
    for fitting in &fittings.all {
        let part = scene.part(SceneSurface::Fitting(fitting.finish as usize));
        add_prism(&fitting.footprint, fitting.span_m, fitting.span_m[0] > 0.0, part);
    }
}

/// Adds a prism over a convex polygon, with its underside or without.
pub(super) fn add_prism(corners: &[Vec2], [low_m, high_m]: [f64; 2], closed: bool, part: &mut MeshBuilder) {
    for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        add_upright([a, b], [low_m, high_m], part);
    }
    add_face(corners.iter().copied(), high_m, 1.0, part);
    if closed {
        add_face(corners.iter().rev().copied(), low_m, -1.0, part);
    }
}

fn add_face(corners: impl Iterator<Item = Vec2>, height_m: f64, up: f64, part: &mut MeshBuilder) {
    let corner =
        |p: Vec2| MeshVertex { position_m: [p.x, p.y, height_m], normal: [0.0, 0.0, up], uv: [p.x, -up * p.y] };
    let corners: Vec<MeshVertex> = corners.map(corner).collect();
    part.polygon(&corners);
}
