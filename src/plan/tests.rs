use super::*;
use std::format;
use std::string::ToString;
use std::vec::Vec;

fn scene() -> Scene {
    Scene::new(240, 240).range(1.0, 32.0).model(2.0, 2.0).triangle(1.0, 0.02)
}

/// The places of a plan's knobs in their lists.
fn ranks(plan: &Plan) -> [usize; 3] {
    let point = POINTS
        .iter()
        .position(|p| (p.snap_bits, p.transform_bits) == (plan.snap_bits, plan.transform_bits));
    let varied = VARIED.iter().position(|v| {
        (v.every, v.varying_bits, v.newton_steps)
            == (plan.every, plan.varying_bits, plan.newton_steps)
    });
    [point.unwrap(), varied.unwrap(), plan.depth_bits as usize]
}

/// Over budgets from one that nothing keeps to one that everything does.
#[test]
fn a_larger_budget_never_takes_a_costlier_knob() {
    let scenes = [
        scene().texture(64, 1.0).colors(),
        scene().texture(1024, 4.0),
        scene().triangle(f32::INFINITY, 0.1).colors().texture(128, 8.0),
        scene().triangle(0.0, 0.0).texture(256, 1.0),
    ];
    let mut taken = [const { Vec::<usize>::new() }; 3];
    for scene in scenes {
        let mut last: Option<[usize; 3]> = None;
        for i in 0..400 {
            let budget = 2f32.powf((i - 250) as f32 / 20.0);
            let scene = scene
                .within_pixels(budget / 4.0)
                .within_texels(budget)
                .within_color_steps(0.5 + budget)
                .within_depth_steps(budget);
            let Ok(plan) = Plan::try_new(scene) else {
                assert!(last.is_none(), "{scene:?} is served less than with a smaller budget");
                continue;
            };
            let ranks = ranks(&plan);
            if let Some(last) = last {
                // The exact tier has fewer corrections to choose from.
                let same_tier = (ranks[0] >= 4) == (last[0] >= 4);
                assert!(ranks[0] <= last[0] && ranks[2] <= last[2], "{scene:?}: {plan:?}");
                assert!(!same_tier || ranks[1] <= last[1], "{scene:?}: {plan:?}");
            }
            last = Some(ranks);
            for (taken, rank) in taken.iter_mut().zip(ranks) {
                if !taken.contains(&rank) {
                    taken.push(rank);
                }
            }
        }
    }
    assert!(taken[0].len() >= 4 && taken[1].len() >= 6 && taken[2].len() == 2, "{taken:?}");
}

/// Each bound, by the name of what is to be changed.
#[test]
fn errors_name_the_field() {
    let good = scene().texture(64, 1.0).colors();
    assert!(Plan::try_new(good).is_ok());
    let bad = [
        ("`width`", Scene { width: 513, ..good }),
        ("`height`", Scene { height: 0, ..good }),
        ("`near`", Scene { near: 0.0, ..good }),
        ("`near`", Scene { near: f32::NAN, ..good }),
        ("`far`", Scene { far: 0.5, ..good }),
        ("`far`", Scene { far: 40_000.0, ..good }),
        ("`extent`", Scene { extent: 20_000.0, ..good }),
        ("`stretch`", Scene { stretch: 9_000.0, ..good }),
        ("`deep`", Scene { deep: -1.0, ..good }),
        ("`tilt`", Scene { tilt: f32::NAN, ..good }),
        ("`texture`", Scene { texture: 4097, ..good }),
        ("`coordinate`", Scene { coordinate: 128.0, ..good }),
        ("`repeats`", Scene { repeats: 300.0, ..good }),
        ("`pixels`", Scene { pixels: 1e-5, ..good }),
        ("`texels`", Scene { texels: 1e-3, ..good }),
        ("`color_steps`", Scene { color_steps: 0.5, ..good }),
        ("`depth_steps`", Scene { depth_steps: 1e-4, ..good }),
    ];
    for (field, scene) in bad {
        let error = Plan::try_new(scene).expect_err(field);
        assert!(error.to_string().contains(field), "{error} for {field}");
        assert_eq!(format!("{error}"), error.text());
    }
}

/// A plan in a constant is the same as elsewhere, and its knobs are types.
#[test]
fn plans_are_constants() {
    const PLAN: Plan = Plan::new(Scene::new(320, 240).range(1.0, 1.0).texture(256, 1.0));
    assert_eq!(Plan::try_new(PLAN_SCENE), Ok(PLAN));
    const PLAN_SCENE: Scene = Scene::new(320, 240).range(1.0, 1.0).texture(256, 1.0);
    assert_eq!((PLAN.every, PLAN.varying_bits), (0, 16));
    assert_eq!((PLAN.budget.clip_bits, PLAN.budget.depth_bits), (20, 26));
}
