//! Evolution declarations. A missing field has the paper's value or that of the evolution named by `from`.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::check::derived::{self, CheckState};
use crate::check::fields::{self, Fields};
use crate::check::library;
use crate::check::names::{Home, Names};
use crate::check::quantity;
use crate::check::wording;
use crate::check::world::{self, Worlds};
use crate::syntax::tree::{NameSyntax, Number, Quantity, RecordDeclaration, ValueKind, ValueSyntax};
use nbc_base::diag::Diagnostic;
use nbc_base::model::LEAST_ACTUATORS;
use nbc_base::model::{
    Axis, Behavior, Count, Evolution, Function, Genome, ImageOrder, Material, MaterialKind, Matter, MutationWeights,
    NamedSchedule, Niche, Palette, Pattern, PhysicsWorld, Program, Response, Rules, SampledWorlds, Schedule,
    SearchObjective, Spell, StartBodies, Symmetry, Variation,
};
use nbc_base::source::Span;

/// In voxels.
const MAX_BOX: u32 = 64;

const MAX_SEEDS: u32 = 10_000;

pub(crate) struct Known<'a> {
    pub(crate) program: &'a Program,
    pub(crate) names: &'a Names,
    pub(crate) worlds: Worlds<'a>,
    pub(crate) checked: &'a [CheckState<NamedEvolution>],
}

/// An evolution whose sensors still name stimuli of the program, so that others can take its materials or its schedule.
#[derive(Clone, Debug)]
pub(crate) struct NamedEvolution {
    evolution: Evolution,
    /// The world that it, or the evolution it derives from, names.
    world: Option<PhysicsWorld>,
    /// The two or three stimuli of its schedule, as ascending indices of [`Program::stimuli`].
    stimuli: Vec<usize>,
}

impl NamedEvolution {
    pub(crate) fn into_evolution(self) -> Evolution {
        let Self { evolution, stimuli, .. } = self;
        let own = |material: &Material| match material.kind {
            MaterialKind::Sensor(response) => {
                let stimulus = stimuli.binary_search(&response.stimulus).expect("its schedule has every stimulus");
                Material { kind: MaterialKind::Sensor(Response { stimulus, ..response }), ..material.clone() }
            }
            _ => material.clone(),
        };
        let palette = Arc::new(Palette::new(evolution.palette.materials().iter().map(own).collect()));
        Evolution { palette, ..evolution }
    }

    fn deaf_sensor(&self) -> Option<(&Material, usize)> {
        self.evolution.palette.materials().iter().find_map(|material| match material.kind {
            MaterialKind::Sensor(Response { stimulus, .. }) if !self.stimuli.contains(&stimulus) => {
                Some((material, stimulus))
            }
            _ => None,
        })
    }
}

pub(crate) fn evolution(
    source: &RecordDeclaration,
    home: Home,
    known: &Known<'_>,
    faults: &mut Vec<Diagnostic>,
) -> CheckState<NamedEvolution> {
    let mut fields = Fields::new("evolution", source);
    let base = fields
        .read("from", &known.checked[0], |value| derived::base(value, home, &known.names.evolutions, known.checked));
    let (NamedEvolution { evolution: base, world, stimuli }, whole) = match base {
        CheckState::Sound(base) => (NamedEvolution::clone(base), true),
        // The first evolution of the prelude has the default values of the others.
        _ => (
            NamedEvolution { evolution: paper(), world: None, stimuli: Vec::new() },
            source.record.field("from").is_none(),
        ),
    };
    if !whole {
        fields.note_fault();
    }
    let (width, height) = fields.read("box", (base.width, base.height), area);
    let palette = fields.read("materials", None, |value| palette(value, home, known).map(Some));
    let genome = genome(&mut fields, base.genome);
    let start = start(&mut fields, base.start, genome, home, known);
    let variable = fields.read("variable", None, |value| schedule(value, home, known).map(Some));
    let (stimuli, variable) = variable.unwrap_or((stimuli, base.variable));
    let objective = fields.choose("objective", base.objective, &SearchObjective::ALL);
    let shows = objective == SearchObjective::Images;
    let shown = fields.read("shown", base.shown, |value| fields::choice(value, &ImageOrder::ALL));
    let world = fields.read("world", world, |value| known.worlds.of(value, home).map(|named| Some(named.world)));
    let evolution = Evolution {
        name: source.name.text.clone(),
        width,
        height,
        palette: palette.unwrap_or(base.palette),
        genome,
        start,
        mutation: fields.read("mutation", base.mutation, mutation),
        variable,
        shown: if shows { shown } else { ImageOrder::Apart },
        fixed_steps: fields.read("fixed", base.fixed_steps, steps),
        descriptors: fields.read_list("descriptors", axis).unwrap_or(base.descriptors),
        batch: fields.read("batch", base.batch as u32, |value| quantity::count(value, 1..=1_000_000)) as usize,
        newcomers: fields.read("newcomers", base.newcomers as u32, |value| quantity::count(value, 0..=1_000_000))
            as usize,
        generations: fields.read("generations", base.generations, |value| quantity::count(value, 1..=u32::MAX)),
        seeds: seeds(&mut fields).unwrap_or(base.seeds),
        rules: rules(&mut fields, base.rules, genome),
        objective,
        behaviors: behaviors(&mut fields, base.behaviors, objective),
        symmetry: symmetry(&mut fields, base.symmetry, objective),
        niche: fields.read("niche", base.niche, niche),
        world: world.unwrap_or_else(|| known.worlds.default(home).world),
        sample: sample(&mut fields, base.sample, objective),
    };
    let found = fields.finish();
    let sound = found.is_empty() && whole;
    faults.extend(found);
    let checked = NamedEvolution { evolution, world, stimuli };
    let misfit = if sound { misfit(source, &checked, known.program) } else { None };
    let fits = misfit.is_none();
    faults.extend(misfit);
    if sound && fits { CheckState::Sound(Box::new(checked)) } else { CheckState::Faulty }
}

fn misfit(source: &RecordDeclaration, checked: &NamedEvolution, program: &Program) -> Option<Diagnostic> {
    other_objective(source, checked)
        .or_else(|| deaf_sensor(source, checked, program))
        .or_else(|| unsensed(source, checked, program))
        .or_else(|| foreign_behavior(source, checked))
}

fn other_objective(source: &RecordDeclaration, checked: &NamedEvolution) -> Option<Diagnostic> {
    let Evolution { variable, objective, .. } = &checked.evolution;
    let shows = variable.spells.iter().any(|spell| spell.image.is_some());
    let fits = shows == (*objective == SearchObjective::Images);
    let at = chosen(source, &["variable", "objective"]);
    let error = if shows { wording::images_without_objective } else { wording::objective_without_images };
    (!fits).then(|| error(at))
}

/// The paper's two stimuli may be unsensed; a third one, or an image, may not.
fn unsensed(source: &RecordDeclaration, checked: &NamedEvolution, program: &Program) -> Option<Diagnostic> {
    let is_sensed = |stimulus: usize| {
        let kinds = checked.evolution.palette.materials().iter().map(|material| material.kind);
        kinds.into_iter().any(|kind| matches!(kind, MaterialKind::Sensor(response) if response.stimulus == stimulus))
    };
    let unsensed = checked.stimuli.iter().copied().find(|&stimulus| !is_sensed(stimulus));
    let shows = checked.evolution.objective == SearchObjective::Images;
    let stimulus = unsensed.filter(|_| checked.stimuli.len() > 2 || shows)?;
    let error = if shows { wording::unsensed_image } else { wording::unsensed_stimulus };
    Some(error(program.stimuli.get(stimulus)?, chosen(source, &["materials", "variable"])))
}

fn foreign_behavior(source: &RecordDeclaration, checked: &NamedEvolution) -> Option<Diagnostic> {
    let stimuli = checked.stimuli.len();
    let behavior = checked.evolution.behaviors.iter().find(|behavior| behavior.stimuli() != stimuli)?;
    let at = chosen(source, &["behaviors", "variable"]);
    Some(wording::foreign_behavior(&behavior.to_string(), behavior.stimuli(), stimuli, at))
}

fn chosen(source: &RecordDeclaration, fields: &[&str]) -> Span {
    let field = fields.iter().find_map(|field| source.record.field(field));
    field.map_or(source.name.span, |field| field.value.span)
}

fn deaf_sensor(source: &RecordDeclaration, checked: &NamedEvolution, program: &Program) -> Option<Diagnostic> {
    let (material, stimulus) = checked.deaf_sensor()?;
    let name = |stimulus: usize| program.stimuli.get(stimulus).map(String::as_str);
    let given: Vec<&str> = checked.stimuli.iter().filter_map(|&stimulus| name(stimulus)).collect();
    Some(wording::deaf_sensor(&material.name, name(stimulus)?, &given, chosen(source, &["variable", "materials"])))
}

/// The paper's evolution without its materials and stimuli, which the prelude declares.
fn paper() -> Evolution {
    Evolution {
        name: String::new(),
        width: 5,
        height: 5,
        palette: Arc::new(Palette::new(Vec::new())),
        genome: Genome::default(),
        start: None,
        mutation: MutationWeights::default(),
        variable: Schedule::default(),
        shown: ImageOrder::default(),
        fixed_steps: 10 * nbc_base::model::CYCLE_STEPS,
        descriptors: Vec::new(),
        batch: 16,
        newcomers: 1,
        generations: 3000,
        seeds: vec![1],
        rules: Rules::default(),
        objective: SearchObjective::default(),
        behaviors: Vec::new(),
        symmetry: Symmetry::default(),
        niche: Niche::default(),
        world: PhysicsWorld::default(),
        sample: None,
    }
}

/// What a body does before one image says nothing about others.
fn symmetry(fields: &mut Fields<'_>, base: Symmetry, objective: SearchObjective) -> Symmetry {
    let words = [("none", Symmetry::None), ("npn", Symmetry::Npn)];
    let symmetry = fields.read("symmetry", base, |value| fields::choice(value, &words));
    if objective == SearchObjective::Images { Symmetry::None } else { symmetry }
}

fn is_of_gates(objective: SearchObjective) -> bool {
    matches!(objective, SearchObjective::Gate | SearchObjective::Wave)
}

fn behaviors(fields: &mut Fields<'_>, base: Vec<Behavior>, objective: SearchObjective) -> Vec<Behavior> {
    let mut behaviors = fields.read_list("behaviors", library::behavior).unwrap_or(base);
    behaviors.sort_unstable_by_key(|behavior| behavior.function());
    behaviors.dedup();
    if is_of_gates(objective) { behaviors } else { Vec::new() }
}

fn rules(fields: &mut Fields<'_>, base: Rules, genome: Genome) -> Rules {
    let whole = [("paper", Rules::PAPER), ("code", Rules::CODE)].into_iter();
    let parts = Matter::WORDS.into_iter().map(|(word, matter)| (word, Rules::from(matter)));
    let words: Vec<_> = whole.chain(parts).collect();
    let read = fields.read_list("as", |value| match fields::choice(value, &words)? {
        // Of these matters, only the sensors are those of other bodies than networks make.
        rules if !genome.is_cppn() && rules != Rules::PAPER && !rules.follow_code(Matter::Sensors) => {
            Err(wording::matter_of_networks(value.span))
        }
        rules => Ok(rules),
    });
    read.map_or(base, |rules| rules.into_iter().fold(Rules::PAPER, Rules::and))
}

fn sample(fields: &mut Fields<'_>, base: Option<SampledWorlds>, objective: SearchObjective) -> Option<SampledWorlds> {
    let usual = base.map_or(Variation::default(), |base| base.vary);
    let before = fields.faults.len();
    let vary = fields.read("vary", usual, world::variation);
    if fields.faults.len() > before {
        fields.note_fault();
    }
    if vary != Variation::default() {
        fields.note("vary", "");
    }
    let usual = base.map_or(SampledWorlds::USUAL, |base| base.worlds);
    let worlds = fields.read("worlds", usual, |value| quantity::count(value, 1..=SampledWorlds::MOST));
    let is_used = vary != Variation::default() && is_of_gates(objective);
    is_used.then_some(SampledWorlds { worlds, vary })
}

/// Only bodies of voxels can start from a library.
fn start(
    fields: &mut Fields<'_>,
    base: Option<StartBodies>,
    genome: Genome,
    home: Home,
    known: &Known<'_>,
) -> Option<StartBodies> {
    let start = fields.read("start", base, |value| {
        let name = fields::name(value, "library")?;
        known.names.libraries.resolve(name, home)?;
        Ok(Some(StartBodies { library: name.text.clone(), bodies: Vec::new() }))
    });
    start.filter(|_| !genome.is_cppn())
}

/// Only voxels can be crossed.
fn genome(fields: &mut Fields<'_>, base: Genome) -> Genome {
    let usual = match base {
        Genome::Cppn => 0.0,
        Genome::Voxels { crossover } => crossover,
    };
    let voxels = Genome::Voxels { crossover: usual };
    let genome = fields.choose("genome", base, &[("cppn", Genome::Cppn), ("voxels", voxels)]);
    let crossover = fields.read("crossover", usual, world::share);
    if genome.is_cppn() { genome } else { Genome::Voxels { crossover } }
}

fn area(value: &ValueSyntax) -> Result<(usize, usize), Diagnostic> {
    let ValueKind::Product(width, height) = &value.kind else {
        return Err(wording::wrong_kind(wording::BOX, value.span));
    };
    let side = |side: &Number| {
        let found = quantity::whole(quantity::number(side)?, 1..=MAX_BOX, side.span, "voxels")?;
        Ok::<_, Diagnostic>(found as usize)
    };
    let (columns, rows) = (side(width)?, side(height)?);
    if columns * rows < LEAST_ACTUATORS {
        return Err(wording::small_box(columns, rows, LEAST_ACTUATORS, value.span));
    }
    Ok((columns, rows))
}

fn palette(value: &ValueSyntax, home: Home, known: &Known<'_>) -> Result<Arc<Palette>, Diagnostic> {
    let mut materials: Vec<Material> = Vec::new();
    let values = fields::list(value);
    if values.is_empty() || values.len() > Palette::MAX_MATERIALS {
        return Err(wording::palette_size(values.len(), Palette::MAX_MATERIALS, value.span));
    }
    for value in values {
        let name = fields::name(value, "material")?;
        let material = known.names.materials.resolve(name, home)?.map(|at| &known.program.materials[at]);
        if materials.iter().any(|known| known.name == name.text) {
            return Err(wording::repeated_material(name));
        }
        materials.extend(material.cloned());
    }
    // The kind of a material with errors is unknown.
    let are_known = materials.len() == values.len();
    if are_known && !materials.iter().any(|material| matches!(material.kind, MaterialKind::Actuator(_))) {
        return Err(wording::no_actuator(LEAST_ACTUATORS, value.span));
    }
    Ok(Arc::new(Palette::new(materials)))
}

fn schedule(value: &ValueSyntax, home: Home, known: &Known<'_>) -> Result<(Vec<usize>, Schedule), Diagnostic> {
    let name = fields::name(value, "schedule")?;
    let Some(found) = known.names.schedules.resolve(name, home)?.map(|at| &known.program.schedules[at]) else {
        return Ok(Default::default());
    };
    if !found.sets.is_empty() {
        return if found.sets.len() > 1 {
            Ok((found.stimuli.clone(), found.schedule.clone()))
        } else {
            Err(wording::one_set(name))
        };
    }
    if !(2..=Function::MOST_INPUTS).contains(&found.stimuli.len()) {
        return Err(wording::wrong_stimuli(name, found.stimuli.len()));
    }
    if let Some(fault) = missing_patterns(found, name) {
        return Err(fault);
    }
    let mut stimuli = found.stimuli.clone();
    stimuli.sort_unstable();
    let own = |spell: &Spell| Spell { pattern: restricted(spell.pattern, &stimuli), ..spell.clone() };
    let schedule = Schedule { spells: found.schedule.spells.iter().map(own).collect() };
    Ok((stimuli, schedule))
}

fn restricted(pattern: Pattern, stimuli: &[usize]) -> Pattern {
    Pattern::new(&stimuli.iter().map(|&stimulus| pattern.has(stimulus)).collect::<Vec<_>>())
}

/// A behavior is the response of a body to each pattern of its stimuli.
fn missing_patterns(schedule: &NamedSchedule, name: &NameSyntax) -> Option<Diagnostic> {
    let shown =
        |pattern| schedule.schedule.spells.iter().any(|spell| restricted(spell.pattern, &schedule.stimuli) == pattern);
    let stimuli = schedule.stimuli.len();
    let missing = Pattern::all(stimuli).filter(|&pattern| !shown(pattern));
    let missing: Vec<String> = missing.map(|pattern| pattern.digits(stimuli)).collect();
    (!missing.is_empty()).then(|| wording::missing_patterns(name, &missing))
}

fn steps(value: &ValueSyntax) -> Result<u32, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(quantity) => quantity::steps(quantity),
        _ => Err(wording::wrong_kind(&wording::time_such_as("10 cycles"), value.span)),
    }
}

fn axis(value: &ValueSyntax) -> Result<Axis, Diagnostic> {
    let ValueKind::Bins(name, bins) = &value.kind else {
        return match fields::word(value, wording::AXIS) {
            Ok(name) if name.text == "behavior" => Ok(Axis::Behavior),
            Ok(name) if name.text == "class" => Ok(Axis::Class),
            _ => Err(fields::not_one_of(value, wording::AXIS, &["behavior", "class"])),
        };
    };
    let of = match name.text.as_str() {
        "voxels" => Count::Voxels,
        "active" => Count::Active,
        "sensory" => Count::Sensory,
        _ => return Err(fields::unknown_word(name, wording::AXIS, &["voxels", "active", "sensory"])),
    };
    let bins = quantity::whole(quantity::number(bins)?, 1..=1000, bins.span, "bins")?;
    Ok(Axis::Count { of, bins: bins as usize })
}

/// A number, a list of numbers, or a range that includes both ends.
fn seeds(fields: &mut Fields<'_>) -> Option<Vec<u64>> {
    if let Some(ValueSyntax { kind: ValueKind::Range(first, last), span }) = fields.value("seed") {
        return fields.read("seed", None, |_| range_of_seeds(first, last, *span).map(Some));
    }
    let mut known = BTreeMap::new();
    fields.read_list("seed", |value| {
        let ValueKind::Quantity(seed) = &value.kind else {
            return Err(wording::wrong_kind(wording::NUMBER, value.span));
        };
        let seed = quantity::seed(seed)?;
        match known.insert(seed, value.span) {
            None => Ok(seed),
            Some(first) => Err(wording::repeated_seed(seed, first, value.span)),
        }
    })
}

fn range_of_seeds(first: &Quantity, last: &Quantity, span: Span) -> Result<Vec<u64>, Diagnostic> {
    let (first, last) = (quantity::seed(first)?, quantity::seed(last)?);
    if first > last || last - first >= u64::from(MAX_SEEDS) {
        return Err(wording::seed_range(MAX_SEEDS, span));
    }
    Ok((first..=last).collect())
}

fn niche(value: &ValueSyntax) -> Result<Niche, Diagnostic> {
    match &value.kind {
        ValueKind::Applied(name, size) if name.text == "pareto" && size.len() == 1 => {
            Ok(Niche::Pareto(quantity::count(&size[0], 1..=1000)? as usize))
        }
        ValueKind::Applied(name, _) if name.text != "pareto" => {
            Err(fields::unknown_word(name, wording::NICHE, &["pareto"]))
        }
        _ => fields::choice(value, &[("dominance", Niche::Dominance)])
            .map_err(|_| fields::not_one_of(value, wording::NICHE, &["dominance", "pareto"])),
    }
}

fn mutation(value: &ValueSyntax) -> Result<MutationWeights, Diagnostic> {
    let ValueKind::Record(record) = &value.kind else {
        return Err(wording::wrong_kind(wording::WEIGHTS, value.span));
    };
    let mut fields = Fields::inner("mutation", value.span, record);
    let weights = MutationWeights {
        add_node: fields.read("add_node", 1.0, weight),
        remove_node: fields.read("remove_node", 1.0, weight),
        add_link: fields.read("add_link", 1.0, weight),
        remove_link: fields.read("remove_link", 1.0, weight),
        change_activation: fields.read("change_activation", 1.0, weight),
        change_weight: fields.read("change_weight", 1.0, weight),
    };
    let MutationWeights { add_node, remove_node, add_link, remove_link, change_activation, change_weight } = weights;
    let all = [add_node, remove_node, add_link, remove_link, change_activation, change_weight];
    match fields.finish().into_iter().next() {
        Some(fault) => Err(fault),
        None if all.iter().all(|weight| *weight == 0.0) => Err(wording::no_mutation(value.span)),
        None => Ok(weights),
    }
}

fn weight(value: &ValueSyntax) -> Result<f64, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(quantity) => quantity::within(quantity::bare(quantity)?, 0.0..=1e6, value.span),
        _ => Err(wording::wrong_kind(wording::WEIGHT, value.span)),
    }
}
