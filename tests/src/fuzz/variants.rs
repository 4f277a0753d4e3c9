//! [`Variant`]: wasmtime set up in another way than by the host, with a second, small
//! player on it.
//!
//! What a robot answers may depend on nothing but the robot, so all variants have to see
//! the same answers as the host. The player shares no code with the host's: it calls
//! robots through wasmtime's dynamic interface and knows neither fuel nor journal.

use wasmouse::maze::{Maze, Turn};
use wasmouse::robot::componentize::JOURNAL_IMPORT;
use wasmouse::robot::engine_config;
use wasmouse::sim::{Action, BudgetScope, Ruleset, Run, Sensors, Simulation, Trace};
use wasmtime::component::{Component, Func, Instance, Linker, Val};
use wasmtime::{Config, Engine, InstanceAllocationStrategy, OptLevel, Store, Trap};

use crate::module::versioned;

/// A way to set up wasmtime.
pub struct Variant {
    /// What is different.
    pub name: &'static str,
    engine: Engine,
    linker: Linker<()>,
    has_fuel: bool,
}

/// What a robot did in a match.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Moves {
    /// Its answers, in order.
    pub actions: Vec<Action>,
    /// Why it did not answer in the end: a trap, or something else.
    pub failure: Option<Option<Trap>>,
}

type Result<T> = wasmtime::Result<T>;

impl Variant {
    /// All variants, the host's own setting first.
    ///
    /// # Errors
    ///
    /// When the machine cannot give the address space.
    pub fn all(rules: &Ruleset) -> Result<Vec<Self>> {
        let config = || engine_config(&rules.limits, 1);
        let mut without_fuel = config();
        without_fuel.consume_fuel(false);
        let mut not_optimised = config();
        not_optimised.cranelift_opt_level(OptLevel::None);
        let mut small = config();
        small.cranelift_opt_level(OptLevel::SpeedAndSize);
        let mut on_demand = config();
        on_demand.allocation_strategy(InstanceAllocationStrategy::OnDemand);
        Ok(vec![
            Self::new("as the host", &config(), true)?,
            Self::new("without fuel", &without_fuel, false)?,
            Self::new("not optimised", &not_optimised, true)?,
            Self::new("optimised for size", &small, true)?,
            Self::new("on demand", &on_demand, true)?,
        ])
    }

    fn new(name: &'static str, config: &Config, has_fuel: bool) -> Result<Self> {
        let engine = Engine::new(config)?;
        Ok(Self {
            name,
            linker: linker(&engine)?,
            engine,
            has_fuel,
        })
    }

    /// Plays a match.
    ///
    /// # Errors
    ///
    /// When the file is no robot.
    pub fn play(
        &self,
        component: &[u8],
        (maze, rules): (&Maze, &Ruleset),
        (seed, setting): (u64, u32),
    ) -> Result<Moves> {
        let component = Component::from_binary(&self.engine, component)?;
        let mut store = Store::new(&self.engine, ());
        store.set_epoch_deadline(1);
        if self.has_fuel {
            store.set_fuel(u64::MAX)?;
        }
        let mut moves = Moves {
            actions: Vec::new(),
            failure: None,
        };
        let briefing = briefing(maze, rules, seed, setting);
        let begun = self
            .linker
            .instantiate(&mut store, &component)
            .and_then(|it| {
                let start = function(&mut store, &it, "start")?;
                start.call(&mut store, &[briefing], &mut [])?;
                function(&mut store, &it, "next-move")
            });
        let next_move = match begun {
            Ok(next_move) => next_move,
            Err(error) => {
                moves.failure = Some(error.downcast_ref().copied());
                return Ok(moves);
            }
        };
        let mut trace = Trace::default();
        let mut simulation = Simulation::new(maze, rules, &mut trace);
        while simulation.end().is_none() {
            let mut answer = [Val::Bool(false)];
            let sensors = sensors(simulation.sense());
            match next_move.call(&mut store, &[sensors], &mut answer) {
                Ok(()) => {
                    let [answer] = answer;
                    let action = action(answer);
                    moves.actions.push(action);
                    simulation.apply(action);
                }
                Err(error) => {
                    moves.failure = Some(error.downcast_ref().copied());
                    break;
                }
            }
        }
        debug_assert!(simulation.steps(Run::Exploration) <= rules.budget);
        Ok(moves)
    }
}

fn linker(engine: &Engine) -> Result<Linker<()>> {
    let mut linker = Linker::new(engine);
    linker.instance(&versioned("wasmouse:robot/types@VERSION"))?;
    let mut journal = linker.instance(JOURNAL_IMPORT)?;
    for name in ["log", "paint", "label", "wall"] {
        journal.func_new(name, |_, _, _, _| Ok(()))?;
    }
    journal.func_new("panic", |_, _, _, _| Err(wasmtime::Error::msg("panicked")))?;
    Ok(linker)
}

fn function(store: &mut Store<()>, instance: &Instance, name: &str) -> Result<Func> {
    let missing = || wasmtime::Error::msg("no such export");
    let name_of_controller = versioned("wasmouse:robot/controller@VERSION");
    let controller = instance
        .get_export_index(&mut *store, None, &name_of_controller)
        .ok_or_else(missing)?;
    let index = instance
        .get_export_index(&mut *store, Some(&controller), name)
        .ok_or_else(missing)?;
    instance.get_func(&mut *store, index).ok_or_else(missing)
}

fn record<const N: usize>(fields: [(&str, Val); N]) -> Val {
    let fields = fields.into_iter();
    Val::Record(
        fields
            .map(|(name, value)| (name.to_owned(), value))
            .collect(),
    )
}

fn briefing(maze: &Maze, rules: &Ruleset, seed: u64, setting: u32) -> Val {
    let cell = |x: u8, y: u8| record([("x", Val::U32(x.into())), ("y", Val::U32(y.into()))]);
    let (start, goal) = (maze.start(), maze.goal());
    let scope = match rules.budget_scope {
        BudgetScope::BothRuns => "both-runs",
        BudgetScope::EachRun => "each-run",
    };
    record([
        ("dimension", Val::U32(maze.dimension().into())),
        ("start", cell(start.x, start.y)),
        (
            "goal",
            record([
                ("origin", cell(goal.origin().x, goal.origin().y)),
                ("width", Val::U32(goal.width().into())),
                ("height", Val::U32(goal.height().into())),
            ]),
        ),
        ("budget", Val::U32(rules.budget)),
        ("budget-scope", Val::Enum(scope.to_owned())),
        ("longest-move", Val::U32(rules.longest_move.into())),
        ("units-per-cell", Val::U32(1)),
        ("exploration-divisor", Val::U32(rules.exploration_divisor)),
        ("seed", Val::U64(seed)),
        ("variant", Val::U32(setting)),
    ])
}

fn sensors(sensors: Sensors) -> Val {
    record([
        ("left", Val::U32(sensors.left.into())),
        ("front", Val::U32(sensors.front.into())),
        ("right", Val::U32(sensors.right.into())),
    ])
}

/// The answer, whose type wasmtime has checked.
fn action(answer: Val) -> Action {
    let Val::Variant(_, Some(payload)) = answer else {
        return Action::Reset;
    };
    let Val::Record(fields) = *payload else {
        unreachable!("a move is a record");
    };
    let [(_, Val::Enum(turn)), (_, Val::S8(advance))] = &fields[..] else {
        unreachable!("a move has a turn and an advance");
    };
    let turn = match turn.as_str() {
        "left" => Turn::Left,
        "straight" => Turn::Straight,
        _ => Turn::Right,
    };
    Action::Move {
        turn,
        advance: *advance,
    }
}
