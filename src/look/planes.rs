//! Loops over a few planes at a time, for vectorisation.

pub(super) fn each_mut(out: &mut [f32], law: impl Fn(f32) -> f32) {
    for out in out {
        *out = law(*out);
    }
}

pub(super) fn each1(out: &mut [f32], a: &[f32], law: impl Fn(f32) -> f32) {
    for (out, &a) in out.iter_mut().zip(a) {
        *out = law(a);
    }
}

pub(super) fn each2(out: &mut [f32], a: &[f32], b: &[f32], law: impl Fn(f32, f32) -> f32) {
    for ((out, &a), &b) in out.iter_mut().zip(a).zip(b) {
        *out = law(a, b);
    }
}

pub(super) fn each3(out: &mut [f32], a: &[f32], b: &[f32], c: &[f32], law: impl Fn(f32, f32, f32) -> f32) {
    for (((out, &a), &b), &c) in out.iter_mut().zip(a).zip(b).zip(c) {
        *out = law(a, b, c);
    }
}

pub(super) fn add1(out: &mut [f32], a: &[f32], law: impl Fn(f32) -> f32) {
    for (out, &a) in out.iter_mut().zip(a) {
        *out += law(a);
    }
}

pub(super) fn add2(out: &mut [f32], a: &[f32], b: &[f32], law: impl Fn(f32, f32) -> f32) {
    for ((out, &a), &b) in out.iter_mut().zip(a).zip(b) {
        *out += law(a, b);
    }
}
