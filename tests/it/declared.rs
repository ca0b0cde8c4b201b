//! Evolution declarations: each field is read from the text and has an effect on the run.

use std::sync::Arc;

use nbc::Session;
use nbc_base::model::{
    Axis, Body, Count, Evolution, Genome, Matter, MutationWeights, Niche, Palette, Pattern, Rules, SampledWorlds,
    Schedule, SearchObjective, Setting, Spell, StartBodies, Symmetry, Trial, Variation,
};
use nbc_base::source::MemoryWorld;
use nbc_sim::Simulator;
use nbc_swarm::evolve::{Search, SearchState};
use nbc_swarm::evolve_generation;

use crate::support::*;

/// Generations within which a change has an effect.
const GENERATIONS: u32 = 6;

const DECLARATIONS: &str = "
schedule other(s1, s2) {
    0 1 for 60 steps
    1 0 for 70 steps
    0 0 for 50 steps
    1 1 for 40 steps
}

evolution base {
    box:         3 x 3
    variable:    short
    fixed:       1 cycles
    batch:       3
    newcomers:   1
    generations: 9
    seed:        3
}
";

#[track_caller]
fn declared(fields: &str) -> Evolution {
    let checked = checked(format!("{SHORT}{DECLARATIONS}\nevolution run {{ from: base, {fields} }}\n"));
    assert_eq!(checked.diagnostics, [], "{fields}");
    checked.program.evolution("run").unwrap().clone()
}

fn states(evolution: &Evolution) -> impl Iterator<Item = SearchState> {
    let mut search = Search::new(evolution, evolution.seeds[0]);
    (0..GENERATIONS).map(move |_| {
        evolve_generation(&mut search);
        search.state()
    })
}

type Change = (&'static str, fn(&mut Evolution));

fn changes() -> Vec<Change> {
    vec![
        ("box: 4 x 3", |run| run.width = 4),
        ("materials: [muscle, bone, flesh, antimuscle, s1_shrink, s2_shrink, s1_grow, s2_grow]", |run| {
            let paper = Palette::paper().materials().to_vec();
            let order = [2, 0, 1, 3, 4, 5, 6, 7];
            run.palette = Arc::new(Palette::new(order.map(|i: usize| paper[i].clone()).to_vec()));
        }),
        (
            "mutation: { add_node: 3, remove_node: 0.5, add_link: 2, remove_link: 0, change_activation: 4, \
             change_weight: 5 }",
            |run| {
                run.mutation = MutationWeights {
                    add_node: 3.0,
                    remove_node: 0.5,
                    add_link: 2.0,
                    remove_link: 0.0,
                    change_activation: 4.0,
                    change_weight: 5.0,
                };
            },
        ),
        ("variable: other", |run| {
            let spell = |pattern: usize, steps| Spell::of(nbc_base::model::Pattern::PAIRS[pattern], steps);
            run.variable = Schedule { spells: vec![spell(1, 60), spell(2, 70), spell(0, 50), spell(3, 40)] };
        }),
        ("fixed: 100 steps", |run| run.fixed_steps = 100),
        ("descriptors: [active in 3 bins, behavior, sensory in 2 bins]", |run| {
            let count = |of, bins| Axis::Count { of, bins };
            run.descriptors = vec![count(Count::Active, 3), Axis::Behavior, count(Count::Sensory, 2)];
        }),
        ("batch: 4", |run| run.batch = 4),
        ("newcomers: 2", |run| run.newcomers = 2),
        ("seed: 8", |run| run.seeds = vec![8]),
        ("as: code", |run| run.rules = Rules::CODE),
        ("as: sigmoid", |run| run.rules = Matter::Sigmoid.into()),
        ("as: [repair, sensors]", |run| run.rules = Rules::from(Matter::Sensors).and(Matter::Repair.into())),
        ("genome: voxels", |run| run.genome = Genome::Voxels { crossover: 0.0 }),
        ("genome: voxels, crossover: 70%", |run| run.genome = Genome::Voxels { crossover: 0.7 }),
        ("box: 7 x 7, genome: voxels, start: shipped", |run| {
            (run.width, run.height) = (7, 7);
            run.genome = Genome::Voxels { crossover: 0.0 };
            run.start = Some(StartBodies { library: "shipped".to_owned(), bodies: Vec::new() });
        }),
        ("objective: gate", |run| run.objective = SearchObjective::Gate),
        ("objective: wave", |run| run.objective = SearchObjective::Wave),
        ("objective: gate, vary: { all: 20%, drag: 0.5, start: 2 }, worlds: 1", |run| {
            let all: Variation = "all=20%,drag=50%,start=2".parse().unwrap();
            run.objective = SearchObjective::Gate;
            run.sample = Some(SampledWorlds { worlds: 1, vary: all });
        }),
        ("objective: wave, behaviors: [xnor, LRRL]", |run| {
            run.objective = SearchObjective::Wave;
            run.behaviors = ["LRRL", "RLLR"].map(|behavior| behavior.parse().unwrap()).to_vec();
        }),
        ("symmetry: npn", |run| run.symmetry = Symmetry::Npn),
        ("niche: pareto(4)", |run| run.niche = Niche::Pareto(4)),
    ]
}

#[test]
fn each_field_is_read_and_nothing_else_changes() {
    let base = declared("");
    assert_eq!((base.width, base.height, base.batch, base.newcomers, base.fixed_steps), (3, 3, 3, 1, 84));
    assert_eq!((base.rules, base.niche), (Rules::PAPER, Niche::Dominance), "the paper's are the usual ones");
    let seeds: Change = ("seed: [5, 2, 9]", |run| run.seeds = vec![5, 2, 9]);
    let range: Change = ("seed: 4..6", |run| run.seeds = vec![4, 5, 6]);
    let generations: Change = ("generations: 77", |run| run.generations = 77);
    for (field, change) in changes().into_iter().chain([seeds, range, generations]) {
        let mut expected = base.clone();
        change(&mut expected);
        assert_ne!(expected, base, "`{field}` is a change");
        assert_eq!(declared(field), expected, "{field}");
    }
}

#[test]
fn each_field_makes_another_run() {
    let base: Vec<_> = states(&declared("")).collect();
    assert!(states(&declared("")).eq(base.iter().cloned()));
    for (field, _) in changes() {
        let changed = states(&declared(field)).zip(&base).any(|(state, of_base)| state != *of_base);
        assert!(changed, "`{field}` changes nothing");
    }
    let mut search = Search::new(&declared("generations: 2"), 3);
    (0..2).for_each(|_| _ = evolve_generation(&mut search));
    assert!(search.is_done());
}

#[test]
fn the_papers_experiment_is_declared_as_the_paper_says() {
    let checked = checked(text_of("library/paper.nb"));
    let program = &checked.program;
    for (name, side) in [("paper5", 5), ("paper7", 7), ("paper10", 10)] {
        let run = program.evolution(name).unwrap();
        assert_eq!((run.width, run.height), (side, side));
        assert_eq!((run.batch, run.generations, run.seeds.len()), (16, 3000, 10), "{name}");
        let patterns = nbc_base::model::Pattern::PAIRS;
        assert_eq!(run.variable.spells, patterns.map(|pattern| Spell::of(pattern, 840)));
        assert_eq!((run.fixed_steps, run.objective, run.niche), (840, SearchObjective::Distance, Niche::Dominance));
        assert_eq!((&run.palette, run.mutation), (&Palette::paper(), MutationWeights::default()));
        assert_eq!(Search::new(run, 1).archive().stats().niches, 1024);
    }
}

#[test]
fn stimuli_of_the_program_are_those_of_the_prelude_by_another_name() {
    let own = "
stimulus light, touch
material eye  { kind: sensor, stimulus: light, absent: 1.6, present: 0.6 }
material skin { kind: sensor, stimulus: touch, absent: 0.6, present: 1.6 }
schedule day(touch, light) { 0 0 for 60 steps 1 0 for 60 steps 0 1 for 60 steps 1 1 for 60 steps }
schedule same(s1, s2) { 0 0 for 60 steps 0 1 for 60 steps 1 0 for 60 steps 1 1 for 60 steps }
evolution own  { box: 3 x 3, materials: [muscle, antimuscle, eye, skin], variable: day, fixed: 1 cycles }
evolution usual { from: own, materials: [muscle, antimuscle, s1_shrink, s2_grow], variable: same }
";
    let checked = checked(own);
    assert_eq!(checked.diagnostics, []);
    let walked = |name: &str| {
        let evolution = checked.program.evolution(name).unwrap();
        let body = Body::new(3, 3, vec![1, 3, 2, 1, 4, 2, 4, 1, 3], Arc::clone(&evolution.palette));
        let schedules = Pattern::PAIRS.map(|pattern| Schedule::constant(pattern, 60));
        let schedules = [evolution.variable.clone()].into_iter().chain(schedules);
        let trials: Vec<Trial> = schedules.map(|schedule| Trial { body: body.clone(), schedule }).collect();
        Simulator::default().run_trials(&Setting::default(), &trials)
    };
    let found = walked("own");
    assert_eq!(found, walked("usual"));
    for (at, one) in found.iter().enumerate() {
        assert!(found[..at].iter().all(|other| other != one), "the body senses both stimuli");
    }
}

#[test]
fn a_search_of_voxels_begins_with_the_robots_that_fit() {
    let mut world = MemoryWorld::default();
    let source = "
        library some { from: shipped, behaviors: [nand, RRRR] }
        evolution own { box: 6 x 7, genome: voxels, start: some, batch: 1, newcomers: 0 }
        evolution other { from: own, box: 4 x 4 }
    ";
    world.insert("run.nb", source.to_owned());
    let mut session = Session::new(world);
    let checked = session.checked("run.nb");
    let said: Vec<&str> = checked.diagnostics.iter().map(|fault| fault.message.as_str()).collect();
    assert_eq!(said, ["no robot of `some` fits into the box and the materials of `other`"]);
    let started = |name: &str| checked.started(checked.program.evolution(name).unwrap(), "out");
    let own = started("own").unwrap();
    let fitting: Vec<Vec<String>> = session
        .shipped()
        .robots
        .iter()
        .filter(|robot| ["RRRL", "RRRR"].contains(&&*robot.behavior.to_string()) && robot.body.width() < 6)
        .map(|robot| {
            let empty = std::iter::repeat_n("0".repeat(6), 7 - robot.body.height());
            empty.chain(robot.body.rows().iter().map(|row| format!("{row}0"))).collect()
        })
        .collect();
    assert!(fitting.len() > 1);
    assert_eq!(own.start.as_ref().unwrap().bodies, fitting);
    let first: Vec<Vec<String>> =
        Search::new(&own, 1).ask().iter().skip(1).map(|candidate| candidate.body.rows()).collect();
    assert_eq!(first, fitting, "after the random body");
    let error = started("other").unwrap_err().list.remove(0);
    assert_eq!(error.message, "no robot of `some` fits into the box and the materials of `other`");
}
