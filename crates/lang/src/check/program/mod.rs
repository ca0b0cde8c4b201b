//! The declarations of all files: first their names, then each kind after the kinds it refers to.

mod claims;
mod runs;

use std::collections::{BTreeMap, BTreeSet};

use crate::check::analysis::Analysis;
use crate::check::circuit::{CheckedCircuit, Header, Headers, circuit};
use crate::check::constant;
use crate::check::declarations::Declarations;
use crate::check::derived::{CheckState, order};
use crate::check::enumeration;
use crate::check::evolution::{self, evolution};
use crate::check::images::{Stimuli, images};
use crate::check::known::{KnownCircuit, KnownCircuits};
use crate::check::library::library;
use crate::check::load::{Loaded, beside};
use crate::check::material::material;
use crate::check::names::{Home, MemberPlace, Names};
use crate::check::recursion;
use crate::check::schedule::{DeclaredImages, schedule};
use crate::check::swarm::{DEFAULT_LIBRARY, swarm};
use crate::check::uses::{NameUse, NameUses};
use crate::check::vocabulary::Vocabulary;
use crate::check::wording;
use crate::check::world::{ProgramFiles, Worlds, world};
use crate::syntax::tree::{self, DeclarationKind, NameSyntax, Number, RecordKeyword, StimulusSyntax};
use nbc_base::budget::WorkBudget;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{
    Circuit, CircuitId, Column, Evolution, ImageSize, Instance, LibrarySource, NamedFile, NamedWorld, Origin, Pattern,
    Program, SearchObjective, Stimulation,
};
use nbc_base::source::{CancelFlag, FileId, SourceWorld, Sources, Span};
use nbc_circuit::elaborate::KeptModules;
use nbc_circuit::{Inspection, Inspector};

/// Circuits of the prelude, and of the files that this program was made of before.
type Known<'k> = (&'k mut BTreeMap<String, KnownCircuit>, &'k mut KnownCircuits);

pub(crate) fn program(files: &dyn SourceWorld, loaded: &Loaded, sources: &Sources, known: Known<'_>) -> Analysis {
    let mut assembly = Assembly::new(loaded, sources);
    assembly.stimuli();
    assembly.materials();
    let beside = ProgramFiles { world: files, sources };
    assembly.images(beside);
    assembly.schedules();
    assembly.worlds(beside);
    assembly.library_names();
    assembly.evolutions();
    assembly.libraries();
    assembly.named_values();
    let (of_prelude, known) = known;
    let is_same = assembly.circuits((of_prelude, &mut *known));
    assembly.swarms();
    assembly.unused_libraries();
    assembly.unused_stimuli();
    let kept = std::mem::take(&mut known.modules);
    let (found, modules) = assembly.build(files.cancel(), kept, &is_same);
    let Inspection { diagnostics, widths, instances, is_cancelled } = found;
    known.modules = modules;
    assembly.faults.extend(diagnostics);
    assembly.forget_redeclared();
    let uses = assembly.uses();
    let (program, diagnostics) = (assembly.program, assembly.faults);
    Analysis { program, diagnostics, uses, widths, instances, is_cancelled, ..Analysis::default() }
}

fn image_size(sides: &[Number; 2]) -> Result<ImageSize, Diagnostic> {
    let most = ImageSize::MAX_SIDE;
    let side = |number: &Number| {
        let found = constant::integer::<usize>(&number.text).filter(|found| (1..=most).contains(found));
        found.ok_or_else(|| wording::image_size(most, number.span))
    };
    let [rows, columns] = sides;
    Ok(ImageSize::new(side(rows)?, side(columns)?))
}

struct Assembly<'a> {
    declarations: Declarations<'a>,
    names: Names,
    program: Program,
    faults: Vec<Diagnostic>,
    /// By the positions of their names.
    worlds: Vec<CheckState<NamedWorld>>,
    circuits: CircuitTable,
    /// By the places of their paths.
    rows: &'a BTreeMap<Span, FileId>,
    /// Circuits of other tools' files.
    read: &'a [Circuit],
    inner: Vec<NameUse>,
}

#[derive(Default)]
struct CircuitTable {
    headers: Headers,
    places: BTreeMap<String, CircuitId>,
    /// Whether a circuit and all circuits it contains have valid names.
    sound: Vec<bool>,
    homes: Vec<Home>,
}

impl CircuitTable {
    fn place(&self, name: &str) -> Option<CircuitId> {
        self.places.get(name).copied()
    }

    fn is_sound(&self, circuit: CircuitId) -> bool {
        self.sound[circuit.0 as usize]
    }
}

#[derive(Clone, Copy)]
enum DeclaredCircuit<'a> {
    /// With the place of the declaration.
    Text(&'a tree::CircuitSyntax, Span),
    Netlist(&'a Circuit),
}

impl DeclaredCircuit<'_> {
    fn name(self) -> NameSyntax {
        match self {
            Self::Text(source, _) => source.name.clone(),
            Self::Netlist(read) => NameSyntax { text: read.name.clone(), span: read.span },
        }
    }

    fn header(self) -> Header {
        match self {
            Self::Text(source, _) => Header::of(source),
            Self::Netlist(read) => Header::read(read),
        }
    }
}

impl<'a> Assembly<'a> {
    fn new(loaded: &'a Loaded, sources: &'a Sources) -> Self {
        Self {
            declarations: Declarations::new(&loaded.trees, sources),
            rows: &loaded.rows,
            read: &loaded.circuits,
            names: Names::new(),
            program: Program::default(),
            faults: Vec::new(),
            worlds: Vec::new(),
            circuits: CircuitTable::default(),
            inner: Vec::new(),
        }
    }

    fn note(&mut self, result: Result<(), Diagnostic>) -> bool {
        let fine = result.is_ok();
        self.faults.extend(result.err());
        fine
    }

    fn stimuli(&mut self) {
        for (home, declaration) in self.declarations.all() {
            let DeclarationKind::Stimulus(stimuli) = &declaration.kind else { continue };
            for stimulus in stimuli {
                self.stimulus(stimulus, home);
            }
        }
    }

    fn stimulus(&mut self, source: &StimulusSyntax, home: Home) {
        let StimulusSyntax { name, image } = source;
        let size = image.as_ref().map(image_size).transpose();
        let size = size.map_err(|fault| self.faults.push(fault)).ok().flatten();
        // A redeclared stimulus of the prelude is the same signal.
        let known = self.names.stimuli.find(&name.text, home);
        let index = known.unwrap_or(self.program.stimuli.len());
        let declared = self.names.stimuli.declare(name, index, home);
        if !self.note(declared) {
            return;
        }
        if let Some(known) = known {
            if self.program.image_sizes.get(&known).copied() != size {
                self.faults.push(wording::other_size(name));
            }
            return;
        }
        self.program.image_sizes.extend(size.map(|size| (index, size)));
        self.program.stimuli.push(name.text.clone());
        if self.program.stimuli.len() == Pattern::MAX_STIMULI + 1 {
            self.faults.push(wording::many_stimuli(Pattern::MAX_STIMULI, name.span));
        }
    }

    fn materials(&mut self) {
        for (home, source) in self.declarations.records(RecordKeyword::Material) {
            let stimuli = Stimuli { names: &self.names.stimuli, image_sizes: &self.program.image_sizes };
            let checked = material(source, home, stimuli, &mut self.faults);
            self.faults.extend(self.names.materials.add(&source.name, checked, home, &mut self.program.materials));
        }
    }

    fn images(&mut self, files: ProgramFiles) {
        for (home, source) in self.declarations.records(RecordKeyword::Images) {
            let stimuli = Stimuli { names: &self.names.stimuli, image_sizes: &self.program.image_sizes };
            let checked = images(source, home, stimuli, files, &mut self.faults);
            self.faults.extend(self.names.images.add(&source.name, checked, home, &mut self.program.images));
        }
    }

    fn schedules(&mut self) {
        for (home, declaration) in self.declarations.all() {
            let DeclarationKind::Schedule(source) = &declaration.kind else { continue };
            let stimuli = Stimuli { names: &self.names.stimuli, image_sizes: &self.program.image_sizes };
            let sets = DeclaredImages { names: &self.names.images, declared: &self.program.images };
            let checked = schedule(source, home, stimuli, sets, &mut self.faults);
            let checked = checked.filter(|_| !self.declarations.is_broken(source.name.span));
            self.faults.extend(self.names.schedules.add(&source.name, checked, home, &mut self.program.schedules));
        }
    }

    fn worlds(&mut self, files: ProgramFiles) {
        let sources = self.declarations.records(RecordKeyword::World);
        for (place, (home, source)) in sources.iter().enumerate() {
            self.faults.extend(self.names.worlds.declare(&source.name, place, *home).err());
        }
        self.worlds = vec![CheckState::Open; sources.len()];
        for place in order(&sources, &self.names.worlds, Some(NamedWorld::DEFAULT)) {
            let (home, source) = sources[place];
            let names = &self.names.worlds;
            let checked = world(source, home, (names, &self.worlds), files, &mut self.faults);
            self.worlds[place] = checked;
        }
        let sound = self.worlds.iter().filter_map(|state| match state {
            CheckState::Sound(world) => Some(NamedWorld::clone(world)),
            _ => None,
        });
        self.program.worlds.extend(sound);
    }

    fn world(&mut self, name: Option<&NameSyntax>) -> Option<NamedWorld> {
        let worlds = Worlds { names: &self.names.worlds, checked: &self.worlds };
        let named = worlds.named(name?, Home::Own);
        named.map_err(|fault| self.faults.push(fault)).ok()
    }

    fn evolutions(&mut self) {
        let sources = self.declarations.records(RecordKeyword::Evolution);
        for (place, (home, source)) in sources.iter().enumerate() {
            self.faults.extend(self.names.evolutions.declare(&source.name, place, *home).err());
        }
        let mut checked = vec![CheckState::Open; sources.len()];
        for place in order(&sources, &self.names.evolutions, None) {
            let (home, source) = sources[place];
            let known = evolution::Known {
                program: &self.program,
                names: &self.names,
                worlds: Worlds { names: &self.names.worlds, checked: &self.worlds },
                checked: &checked,
            };
            checked[place] = evolution(source, home, &known, &mut self.faults);
        }
        let own = sources.iter().filter(|(home, _)| *home == Home::Own);
        self.program.own_evolutions = own.map(|(_, source)| source.name.text.clone()).collect();
        self.program.evolutions.extend(checked.into_iter().filter_map(|state| match state {
            CheckState::Sound(evolution) => Some(evolution.into_evolution()),
            _ => None,
        }));
    }

    fn library_names(&mut self) {
        for (home, source) in self.declarations.records(RecordKeyword::Library) {
            self.faults.extend(self.names.libraries.declare(&source.name, (), home).err());
        }
    }

    fn libraries(&mut self) {
        for (home, source) in self.declarations.records(RecordKeyword::Library) {
            let checked = library(source, home, &self.names.evolutions, self.declarations.sources, &mut self.faults);
            if let Some(LibrarySource { from: Origin::Evolution(name), .. }) = &checked
                && self.program.evolution(name).is_some_and(|found| found.objective == SearchObjective::Images)
                && let Some(from) = source.record.field("from")
            {
                self.faults.push(wording::not_gates(name, from.value.span));
            }
            self.program.libraries.extend(checked);
        }
    }

    fn named_values(&mut self) {
        for (home, declaration) in self.declarations.all() {
            if let DeclarationKind::Enumeration(source) = &declaration.kind {
                self.enumeration(source, home);
            }
        }
        for (home, declaration) in self.declarations.all() {
            match &declaration.kind {
                DeclarationKind::Let(source) => {
                    let declared = Vocabulary::of(&self.names, &self.program);
                    let value = enumeration::integer(source, home, declared, &mut self.faults);
                    self.faults.extend(self.names.integers.declare(&source.name, value.unwrap_or(1), home).err());
                }
                DeclarationKind::File(source) => {
                    let path = beside(&self.declarations.sources.file(source.path.span.file).name, &source.path.text);
                    self.faults.extend(self.names.files.declare(&source.name, self.program.files.len(), home).err());
                    let name = source.name.text.clone();
                    self.program.files.push(NamedFile { name, path, span: source.path.span });
                }
                _ => {}
            }
        }
    }

    fn enumeration(&mut self, source: &tree::EnumerationSyntax, home: Home) {
        let Some(checked) = enumeration::enumeration(source, &mut self.faults) else { return };
        let enumeration = self.program.enumerations.len();
        self.faults.extend(self.names.enumerations.declare(&source.name, enumeration, home).err());
        for (member, source) in source.members.iter().enumerate() {
            self.faults
                .extend(self.names.members.declare(&source.name, MemberPlace { enumeration, member }, home).err());
        }
        self.program.enumerations.push(checked);
    }

    /// Their widths are checked when they are built. Returns whether each is known from before.
    fn circuits(&mut self, (base, files): Known<'_>) -> Vec<bool> {
        let written = self.declarations.all().filter_map(|(home, declaration)| match &declaration.kind {
            DeclarationKind::Circuit(source) => Some((home, DeclaredCircuit::Text(source, declaration.span))),
            _ => None,
        });
        let mut sources: Vec<_> = written.collect();
        let first = sources.partition_point(|(home, _)| *home == Home::Prelude);
        sources.splice(first..first, self.read.iter().map(|read| (Home::Used, DeclaredCircuit::Netlist(read))));
        for (place, (home, source)) in sources.iter().enumerate() {
            self.faults.extend(self.names.circuits.declare(&source.name(), place, *home).err());
            self.circuits.headers.circuits.push(source.header());
            self.circuits.homes.push(*home);
        }
        let prelude = |name| self.names.circuits.find(name, Home::Prelude).map(|at| CircuitId(at as u32));
        (self.program.selector, self.program.stored) = (prelude("select"), prelude("stored"));
        let (mut calls, mut is_same) = (Vec::new(), Vec::new());
        files.begin(&self.circuits.homes, &self.circuits.headers.circuits, self.names.of_bodies());
        let (mut of_prelude, mut of_files) = (std::mem::take(base), std::mem::take(&mut files.circuits));
        for (home, source) in sources {
            let (before, now) = match home {
                Home::Prelude => (&mut of_prelude, &mut *base),
                _ => (&mut of_files, &mut files.circuits),
            };
            let text = |span| self.declarations.sources.text(span);
            let known = match source {
                DeclaredCircuit::Text(_, span) => {
                    before.remove_entry(text(span)).filter(|(_, known)| known.home == home)
                }
                DeclaredCircuit::Netlist(_) => None,
            };
            is_same.push(known.is_some());
            let checked = match (source, known) {
                (DeclaredCircuit::Netlist(read), _) => CheckedCircuit::of(read.clone()),
                (DeclaredCircuit::Text(_, span), Some((text, known))) => {
                    let checked = known.at(span, &self.names, self.declarations.sources);
                    now.insert(text, known);
                    checked
                }
                (DeclaredCircuit::Text(source, span), None) => {
                    let (declared, counts) = (Vocabulary::of(&self.names, &self.program), self.names.counts());
                    let checked = circuit(source, home, declared, &self.circuits.headers, None);
                    let known = KnownCircuit::of(home, span, &checked, &self.names, counts);
                    now.extend(known.map(|known| (text(span).to_owned(), known)));
                    checked
                }
            };
            let is_whole = !self.declarations.is_broken(checked.circuit.span);
            self.circuits.sound.push(is_whole && !checked.diagnostics.iter().any(Diagnostic::is_error));
            self.faults.extend(checked.diagnostics);
            self.inner.extend(checked.uses);
            calls.push(checked.calls);
            if matches!(source, DeclaredCircuit::Text(source, _) if source.is_environment) {
                self.program.environments.push(CircuitId(self.program.circuits.len() as u32));
            }
            self.program.circuits.push(checked.circuit);
        }
        let (faults, sound) = recursion::look(&calls, &self.circuits.sound, &self.circuits.headers);
        self.faults.extend(faults);
        self.circuits.sound = sound;
        self.rename_redeclared();
        for (at, header) in self.circuits.headers.circuits.iter().enumerate() {
            self.circuits.places.entry(header.name.clone()).or_insert(CircuitId(at as u32));
        }
        is_same
    }

    fn uses(&mut self) -> NameUses {
        let mut list = std::mem::take(&mut self.inner);
        list.extend(self.names.take_uses());
        NameUses::new(list)
    }

    fn ports_named(&mut self, circuit: &str, columns: &[NameSyntax]) {
        let Some(place) = self.circuits.place(circuit) else { return };
        let header = &self.circuits.headers.circuits[place.0 as usize];
        self.inner.extend(columns.iter().filter_map(|name| header.port(name)));
    }

    /// If a file redeclares a circuit of the prelude, other circuits of the prelude still use the original.
    fn rename_redeclared(&mut self) {
        for (at, home) in self.circuits.homes.iter().enumerate() {
            let name = &mut self.circuits.headers.circuits[at].name;
            if *home == Home::Prelude && self.names.circuits.is_redeclared(name) {
                *name = format!("prelude.{name}");
                self.program.circuits[at].name.clone_from(name);
            }
        }
    }

    /// The prelude's declarations come first.
    fn forget_redeclared(&mut self) {
        fn keep_last<T>(all: &mut Vec<T>, name: impl Fn(&T) -> &str) {
            let mut seen = BTreeSet::new();
            let last: Vec<_> = all.iter().rev().map(|one| seen.insert(name(one).to_owned())).collect();
            let mut last = last.into_iter().rev();
            all.retain(|_| last.next().unwrap_or(true));
        }
        keep_last(&mut self.program.materials, |material| &material.name);
        keep_last(&mut self.program.images, |images| &images.name);
        keep_last(&mut self.program.schedules, |schedule| &schedule.name);
        keep_last(&mut self.program.evolutions, |evolution| &evolution.name);
        keep_last(&mut self.program.libraries, |library| &library.name);
        keep_last(&mut self.program.swarms, |swarm| &swarm.name);
        keep_last(&mut self.program.worlds, |world| &world.name);
    }

    fn swarms(&mut self) {
        for (home, source) in self.declarations.records(RecordKeyword::Swarm) {
            let worlds = Worlds { names: &self.names.worlds, checked: &self.worlds };
            let declared = Vocabulary::of(&self.names, &self.program);
            let headers = &self.circuits.headers;
            let checked = swarm(source, home, &self.names, declared, headers, worlds, &mut self.faults);
            self.faults.extend(self.names.swarms.add(&source.name, checked, home, &mut self.program.swarms));
        }
    }

    /// Only if the file runs anything: its robots then come from another library.
    fn unused_libraries(&mut self) {
        let runs = |declaration: &tree::Declaration| {
            matches!(declaration.kind, DeclarationKind::Test(_) | DeclarationKind::Simulate(_))
        };
        if !self.declarations.own().any(runs) || self.faults.iter().any(Diagnostic::is_error) {
            return;
        }
        for (home, source) in self.declarations.records(RecordKeyword::Library) {
            let name = source.name.text.as_str();
            let begins = |evolution: &Evolution| evolution.start.as_ref().is_some_and(|start| start.library == name);
            let used = name == DEFAULT_LIBRARY
                || self.program.swarms.iter().any(|swarm| swarm.library == name)
                || self.program.evolutions.iter().any(begins);
            if home == Home::Own && !used {
                self.faults.push(wording::unused_library(&source.name));
            }
        }
    }

    /// Warns of a file's own stimuli that no material senses and no schedule gives, unless it has nothing else.
    fn unused_stimuli(&mut self) {
        let is_other = |declaration: &tree::Declaration| !matches!(declaration.kind, DeclarationKind::Stimulus(_));
        if !self.declarations.own().any(is_other) || self.faults.iter().any(Diagnostic::is_error) {
            return;
        }
        let names = self.declarations.own().filter_map(|declaration| match &declaration.kind {
            DeclarationKind::Stimulus(stimuli) => Some(stimuli.iter().map(|stimulus| &stimulus.name)),
            _ => None,
        });
        let stimuli = &self.names.stimuli;
        let is_unused = |name: &&NameSyntax| {
            let is_new = stimuli.find(&name.text, Home::Prelude).is_none();
            is_new && !name.text.starts_with('_') && !stimuli.is_used(name.span)
        };
        let unused = names.flatten().filter(is_unused);
        self.faults.extend(unused.map(|name| wording::unused("stimulus", &name.text, name.span)));
    }

    fn build(&mut self, cancel: CancelFlag, kept: KeptModules, is_same: &[bool]) -> (Inspection, KeptModules) {
        let mut program = std::mem::take(&mut self.program);
        let mut inspector = Inspector::new(&program, WorkBudget::until(cancel), kept, is_same);
        for (at, home) in self.circuits.homes.iter().enumerate() {
            if *home != Home::Prelude && self.circuits.sound[at] {
                inspector.inspect(CircuitId(at as u32));
            }
        }
        for swarm in &program.swarms {
            self.ports(&swarm.circuit, swarm.span, &mut inspector);
        }
        let simulations = self.simulations(&program, &mut inspector);
        let mut tests = Vec::new();
        for (span, test) in self.declarations.own_tests() {
            tests.extend(self.test(span, test, &program, &mut inspector));
        }
        for test in &tests {
            if let Stimulation::All { reference } | Stimulation::Ever { reference, .. } = &test.stimulation {
                inspector.inspect_body(reference);
            }
        }
        let mut claims = Vec::new();
        for (span, claim) in self.declarations.own_claims() {
            claims.extend(self.claim(span, claim, &program, &mut inspector));
        }
        for claim in &claims {
            inspector.inspect_body(&claim.monitor);
        }
        self.same_titles();
        let found = inspector.finish();
        program.simulations = simulations;
        program.tests = tests;
        program.claims = claims;
        self.program = program;
        found
    }

    /// `None` if the circuit, or one that it contains, is invalid.
    fn ports(
        &self,
        instance: &Instance,
        place: Span,
        inspector: &mut Inspector<'_>,
    ) -> Option<(Vec<Column>, Vec<Column>)> {
        let circuit = self.circuits.place(&instance.circuit).filter(|&circuit| self.circuits.is_sound(circuit))?;
        inspector.ports(circuit, &instance.arguments, place)
    }
}
