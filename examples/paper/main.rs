//! Prints the tables of docs/paper.md from the runs in `out/paper` and `out/long`:
//!
//!     cargo run --release --example paper
//!     cargo run --release --example paper -- transfer mutants gates    only these parts, which simulate for hours

mod complexity;
mod gates;
mod mutants;
mod reached;
mod rules;
mod transfer;

use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};

use nbc_base::model::{Behavior, Direction, Pattern};
use nbc_session::report::{self, BehaviorGroup, GroupComparison, History, ProgressLine, SeedRun};
use nbc_session::store::Checkpoint;
use nbc_swarm::evolve::{Champion, Elite};
use serde::Deserialize;

type Fallible<T> = Result<T, Box<dyn Error>>;

/// The run of one seed.
struct Run {
    results: SeedRun,
    end: End,
}

impl Run {
    /// What it had after some generation.
    fn line(&self, generation: u32) -> Option<&ProgressLine> {
        self.results.progress.iter().find(|line| line.generation == generation)
    }
}

/// Fields of the last line of a run's `progress.jsonl`.
#[derive(Deserialize)]
struct End {
    evaluations: usize,
}

/// The published robots.
#[derive(Deserialize)]
struct Published {
    robots: Vec<PublishedRobot>,
}

impl Published {
    fn read() -> Fallible<Self> {
        Ok(serde_json::from_str(include_str!("../../tests/golden/paper_robots.json"))?)
    }
}

#[derive(Deserialize)]
struct PublishedRobot {
    behavior: Behavior,
    /// The least distance of the four simulations under a constant pattern, in voxels: the paper's second fitness.
    min_displacement: f64,
    body: Vec<String>,
}

/// The generations of the paper's runs.
const LONG: u32 = 3000;
/// Those of the runs in `out/paper`.
const SHORT: u32 = 300;
/// The generations at which runs are compared with what they become.
const MILESTONES: [u32; 5] = [100, SHORT, 500, 1000, LONG];
/// The index of the least distance under a constant pattern among the fitnesses of `objective: distance`.
const LEAST_DISTANCE: usize = 1;

fn main() -> Fallible<()> {
    let boxes = [5, 7, 10];
    let runs: Vec<BTreeMap<u64, Run>> =
        boxes.iter().map(|side| read(&format!("paper/paper{side}"))).collect::<Fallible<_>>()?;
    let (long, code) = (finished(read("long/paper5")?), read("paper/code5")?);
    let parts: Vec<String> = std::env::args().skip(1).collect();
    let is_wanted = |part: &str| parts.is_empty() || parts.iter().any(|wanted| wanted == part);
    let [small, medium, large] = [&runs[0], &runs[1], &runs[2]];
    let long_name = "5x5, 3,000 generations";
    let named = [("5x5", small), ("7x7", medium), ("10x10", large), (long_name, &long)];
    if is_wanted("tables") {
        let [first, second, third, fourth] = named;
        print_runs(&[first, second, third, fourth, ("5x5, as: code", &code)]);
        print_least_distances(&runs);
        let (wide, widest) = (read("long/paper7")?, read("long/paper10")?);
        print_published(&boxes, &runs, &[&long, &wide, &widest])?;
        let whole = [("5x5", &long), ("7x7", &wide), ("10x10", &widest)];
        let short = whole.map(|(name, runs)| Moment::of(name.to_owned(), runs, SHORT));
        let late = whole.map(|(name, runs)| {
            let generation = common_milestone(runs);
            Moment::of(format!("{name}, {}", grouped(generation)), runs, generation)
        });
        let moments: Vec<Moment> = short.into_iter().chain(late).collect();
        print_mirrors(&moments);
        print_difficulties(&moments);
        print_means(&moments);
        print_growth(&whole);
        reached::print_published(&boxes, &[&long, &wide, &widest])?;
        reached::print_claims(&whole);
        print_unfinished(&whole[1..]);
        rules::print_distances(small, &code);
        rules::print_matters(&[
            ("nothing", "paper/paper5"),
            ("all", "paper/code5"),
            ("`repair`", "paper/repair5"),
            ("all but `repair`", "paper/others5"),
        ])?;
        complexity::print(&runs);
    }
    if is_wanted("transfer") {
        transfer::print(&named)?;
    }
    if is_wanted("mutants") {
        mutants::print(&named)?;
    }
    if is_wanted("gates") {
        gates::print(&[
            ("distance, 300 generations", small, LEAST_DISTANCE),
            ("distance, 3,000 generations", &long, LEAST_DISTANCE),
            ("gate", &read("long/gate5")?, 0),
            ("gate, voxels with crossover", &read("long/crossed5")?, 0),
        ])?;
    }
    Ok(())
}

/// The runs in a folder of `out`, by seed.
fn read(name: &str) -> Fallible<BTreeMap<u64, Run>> {
    let mut runs = BTreeMap::new();
    for folder in folders(name)? {
        let checkpoint = Checkpoint::open(&folder.join("checkpoint.nbc")).map_err(|fault| fault.message)?;
        let Some(checkpoint) = checkpoint else { continue };
        let text = std::fs::read_to_string(folder.join("progress.jsonl"))?;
        let end = serde_json::from_str(text.lines().last().unwrap_or_default())?;
        let progress = History::read(&text, checkpoint.state.generation).lines().collect();
        let results = SeedRun { niches: checkpoint.state.niches, progress };
        runs.insert(checkpoint.state.seed, Run { results, end });
    }
    Ok(runs)
}

/// Those of the runs that have the paper's generations. Others are still going on.
fn finished(mut runs: BTreeMap<u64, Run>) -> BTreeMap<u64, Run> {
    runs.retain(|_, run| run.results.progress.last().is_some_and(|line| line.generation >= LONG));
    runs
}

/// The folders of runs in a folder of `out`.
fn folders(name: &str) -> Fallible<Vec<PathBuf>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("out").join(name);
    let missing = |error| format!("{}: {error}; docs/paper.md says how to unpack the archives", folder.display());
    let seeds = std::fs::read_dir(&folder).map_err(missing)?;
    Ok(seeds.map(|seed| Ok(seed?.path())).collect::<Result<_, std::io::Error>>()?)
}

/// What the runs of each declaration found.
fn print_runs(declarations: &[(&str, &BTreeMap<u64, Run>)]) {
    println!("| box | seeds | bodies evaluated | all 16 behaviors after | niches filled | QD-score |");
    println!("|---|---|---|---|---|---|");
    for (name, runs) in declarations {
        let of = |value: &dyn Fn(&Run) -> f64| Spread::of(runs.values().map(value));
        let last = |run: &Run| run.results.progress.last().cloned();
        println!(
            "| {name} | {} | {:.0} | {:.0} | {:.1} % | {:.0} |",
            runs.len(),
            of(&|run| run.end.evaluations as f64),
            of(&whole),
            of(&|run| last(run).map_or(0.0, |line| 100.0 * line.coverage)),
            of(&|run| last(run).map_or(0.0, |line| line.qd_score)),
        );
    }
}

/// The generation in which a run had all behaviors.
fn whole(run: &Run) -> f64 {
    let found = run.results.progress.iter().find(|line| line.best.len() == 16);
    found.map_or(f64::INFINITY, |line| f64::from(line.generation))
}

/// The largest second fitness of each seed, by behavior.
fn print_least_distances(boxes: &[BTreeMap<u64, Run>]) {
    println!("\n| behavior | 5x5 | 7x7 | 10x10 |\n|---|---|---|---|");
    for behavior in Behavior::all(2) {
        print!("| {behavior}");
        boxes.iter().for_each(|runs| print!(" | {:.2}", least_distances(runs, behavior)));
        println!(" |");
    }
}

/// The published robots beside ours of the short and the long runs, by the second fitness.
fn print_published(boxes: &[usize], short: &[BTreeMap<u64, Run>], long: &[&BTreeMap<u64, Run>]) -> Fallible<()> {
    println!("\n| behavior | box | published | best run | median run | best long run |\n|---|---|---|---|---|---|");
    for PublishedRobot { behavior, min_displacement, body } in Published::read()?.robots {
        let Some(place) = boxes.iter().position(|&side| side == body.len()) else { continue };
        let Spread { median, most, .. } = least_distances(&short[place], behavior);
        print!("| {behavior} | {0}x{0} | {min_displacement:.2} | {most:.2} | {median:.2}", body.len());
        println!(" | {:.2} |", least_distances(long[place], behavior).most);
    }
    Ok(())
}

/// In each group, the behavior that starts to the left beside its mirror image.
fn print_mirrors(moments: &[Moment]) {
    print_header("group", moments);
    let starting = |moment: &Moment, direction: Direction| {
        moment.groups(|champion| champion.behavior.direction(Pattern::PAIRS[0]) == direction)
    };
    let sides = moments.iter().map(|one| [Direction::Left, Direction::Right].map(|side| starting(one, side)));
    let sides: Vec<[Vec<BehaviorGroup>; 2]> = sides.collect();
    for place in 0..8 {
        print!("| {}", sides[0][0][place].name);
        for [left, right] in &sides {
            let pair = report::compare_groups(&[left[place].clone(), right[place].clone()]);
            pair.iter().for_each(|pair| print!(" | {:.2} ({:.2})", pair.p, pair.a12));
        }
        println!(" |");
    }
}

/// The paper's order of difficulty: a value for each run is the mean of its groups. The last line compares the robots
/// that follow the first stimulus with those that follow the second.
fn print_difficulties(moments: &[Moment]) {
    print_header("compared", moments);
    let compared: Vec<Vec<GroupComparison>> = moments
        .iter()
        .map(|moment| {
            let eight = moment.groups(|_| true);
            let sides = [1, 2].map(|place| eight[place].clone());
            order(&eight).chain(report::compare_groups(&sides)).collect()
        })
        .collect();
    let names = ["no stimulus, one", "one, both", "both, XOR and XNOR", "first stimulus, second"];
    for (line, name) in names.iter().enumerate() {
        print!("| {name}");
        for pairs in &compared {
            pairs.get(line).iter().for_each(|pair| print!(" | {:.5} ({:.2})", pair.p_adjusted, pair.a12));
        }
        println!(" |");
    }
}

/// The runs of the paper for each box, and Student's t for the 95 % interval of the mean of so many values.
const RUNS: usize = 10;
const T: f64 = 2.262;

/// The mean distance of each group over its runs, with its 95 % interval, in voxels.
fn print_means(moments: &[Moment]) {
    print_header("group", moments);
    let groups: Vec<Vec<BehaviorGroup>> = moments.iter().map(|moment| moment.groups(|_| true)).collect();
    for place in 0..8 {
        print!("| {}", groups[0][place].name);
        for groups in &groups {
            let values = &groups[place].values;
            assert_eq!(values.len(), RUNS, "a mean is of all runs");
            let count = RUNS as f64;
            let mean = values.iter().sum::<f64>() / count;
            let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
            print!(" | {mean:.1} ± {:.1}", T * (squares / (count - 1.0) / count).sqrt());
        }
        println!(" |");
    }
}

/// The generations that each run has which has not the paper's number.
fn print_unfinished(boxes: &[(&str, &BTreeMap<u64, Run>)]) {
    println!();
    for (name, runs) in boxes {
        let last = |run: &Run| run.results.progress.last().map_or(0, |line| line.generation);
        let each: Vec<String> = runs.iter().map(|(seed, run)| format!("{seed}: {}", last(run))).collect();
        println!("{name}, generations by seed: {}", each.join(", "));
    }
}

/// Each difficulty beside the next one.
fn order(groups: &[BehaviorGroup]) -> impl Iterator<Item = GroupComparison> {
    let next = |pair: &GroupComparison| pair.groups[1] == pair.groups[0] + 1;
    report::compare_groups(&by_difficulty(groups)).into_iter().filter(next)
}

/// The groups of a difficulty as one. Each run must have found all of them.
fn by_difficulty(groups: &[BehaviorGroup]) -> Vec<BehaviorGroup> {
    let same = groups.chunk_by(|a, b| a.difficulty == b.difficulty);
    same.map(|groups| {
        let mean = |run: usize| groups.iter().map(|group| group.values[run]).sum::<f64>() / groups.len() as f64;
        BehaviorGroup { values: (0..groups[0].values.len()).map(mean).collect(), ..groups[0].clone() }
    })
    .collect()
}

/// The last milestone that all of these runs have.
fn common_milestone(runs: &BTreeMap<u64, Run>) -> u32 {
    let has = |generation: &u32| runs.values().all(|run| run.line(*generation).is_some());
    MILESTONES.into_iter().rev().find(has).unwrap_or(SHORT)
}

/// The champions that several runs had after some generation.
struct Moment {
    name: String,
    champions: BTreeMap<u64, Vec<Champion>>,
}

impl Moment {
    fn of(name: String, runs: &BTreeMap<u64, Run>, generation: u32) -> Self {
        let champions = |(&seed, run): (&u64, &Run)| {
            let best = run.line(generation).into_iter().flat_map(|line| &line.best);
            let champion = |(&behavior, &fitness)| Champion { behavior, fitness, niches: 0 };
            (seed, best.map(champion).collect())
        };
        Self { name, champions: runs.iter().map(champions).collect() }
    }

    /// The groups of behaviors, of some of the champions.
    fn groups(&self, chosen: impl Fn(&Champion) -> bool) -> Vec<BehaviorGroup> {
        let some = |champions: &Vec<Champion>| champions.iter().filter(|one| chosen(one)).cloned().collect();
        report::behavior_groups(&self.champions.iter().map(|(&seed, champions)| (seed, some(champions))).collect())
    }
}

/// The head of a table with a column for each moment.
fn print_header(first: &str, moments: &[Moment]) {
    let names: Vec<&str> = moments.iter().map(|moment| moment.name.as_str()).collect();
    println!("\n| {first} | {} |\n|---{}|", names.join(" | "), "|---".repeat(names.len()));
}

/// Medians of the runs at some generations: niches, and the mean distances by difficulty, where a behavior that was not
/// found counts as 0; and how many runs have the paper's order. The last line of a box is of the runs that have ended,
/// if others have not.
fn print_growth(boxes: &[(&str, &BTreeMap<u64, Run>)]) {
    println!("\n| box | runs | generations | niches | no stimulus | one | both | XOR and XNOR | runs in order |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for &(name, runs) in boxes {
        for generation in MILESTONES {
            let lines: Vec<&ProgressLine> = runs.values().filter_map(|run| run.line(generation)).collect();
            if lines.is_empty() || (lines.len() < runs.len() && generation < LONG) {
                continue;
            }
            let median = |value: &dyn Fn(&ProgressLine) -> f64| Spread::of(lines.iter().copied().map(value)).median;
            let coverage = 100.0 * median(&|line| line.coverage);
            print!("| {name} | {} | {} | {coverage:.1} % |", lines.len(), grouped(generation));
            (0..4).for_each(|group| print!(" {:.1} |", median(&|line| line.mean_fitness(group))));
            let in_order =
                |line: &&&ProgressLine| (0..4).is_sorted_by(|a, b| line.mean_fitness(*a) > line.mean_fitness(*b));
            println!(" {} |", lines.iter().filter(in_order).count());
        }
    }
}

/// A number of generations with a comma after the thousands.
fn grouped(generation: u32) -> String {
    let thousands = generation / 1000;
    if thousands == 0 { generation.to_string() } else { format!("{thousands},{:03}", generation % 1000) }
}

/// The largest second fitness of each seed's robots with a behavior, in voxels.
fn least_distances(runs: &BTreeMap<u64, Run>, behavior: Behavior) -> Spread {
    let best = |run| champion(run, behavior, LEAST_DISTANCE).map(|elite| elite.fitness[LEAST_DISTANCE]);
    Spread::of(runs.values().filter_map(best))
}

/// The elite of each run and behavior with the largest of the two fitnesses, by its index.
fn champions(runs: &BTreeMap<u64, Run>, fitness: usize) -> Vec<&Elite> {
    let of_run = |run| Behavior::all(2).filter_map(move |behavior| champion(run, behavior, fitness));
    runs.values().flat_map(of_run).collect()
}

fn champion(run: &Run, behavior: Behavior, fitness: usize) -> Option<&Elite> {
    let elites = run.results.niches.iter().flat_map(|(_, elites)| elites);
    let own = elites.filter(|elite| elite.behavior == behavior);
    own.max_by(|a, b| a.fitness[fitness].total_cmp(&b.fitness[fitness]))
}

/// The least value of several runs, their median and the largest.
struct Spread {
    least: f64,
    median: f64,
    most: f64,
}

impl Spread {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.collect();
        values.sort_by(f64::total_cmp);
        let [Some(&least), Some(&most)] = [values.first(), values.last()] else {
            return Self { least: f64::NAN, median: f64::NAN, most: f64::NAN };
        };
        let median = (values[(values.len() - 1) / 2] + values[values.len() / 2]) / 2.0;
        Self { least, median, most }
    }
}

/// As `median (least to most)`.
impl std::fmt::Display for Spread {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let digits = f.precision().unwrap_or(2);
        let number = |value: f64| if value.is_finite() { format!("{value:.digits$}") } else { "never".to_owned() };
        write!(f, "{} ({} to {})", number(self.median), number(self.least), number(self.most))
    }
}
