//! The wall map and the uncertainty map: [`Knowledge`].
//!
//! It takes readings and infers what the contest rules say about cells and about the goal
//! room; it plans nothing. Inferred walls are kept here and not in the tracker's map, so that
//! in a maze that breaks the rules a wrong inference never makes the robot drive through a
//! wall that it has not seen.

use wasmouse_sdk::{Area, Briefing, Cell, Heading, Map, Pose, Sensors, Wall};

/// One side of a cell.
type Side = (Cell, Heading);

/// What the robot believes.
pub struct Knowledge {
    map: Map,
    /// Possible shapes of each cell, row by row.
    shapes: Vec<u8>,
    goal: Area,
    /// Whether the goal is a room by the contest's rules: four cells in the centre,
    /// seven walls, one entrance.
    is_room: bool,
    /// The cell of the goal behind its entrance, once that is known.
    entrance: Option<Cell>,
}

impl Knowledge {
    /// Knows the perimeter and, in the goal room, that nothing stands inside.
    pub fn new(briefing: &Briefing) -> Self {
        let dimension = briefing.dimension;
        let has_room = dimension.is_multiple_of(2) && dimension > 2;
        let is_room = has_room && briefing.goal == Area::center(dimension);
        let mut knowledge = Self {
            map: Map::new(dimension),
            shapes: vec![0; (dimension * dimension) as usize],
            goal: briefing.goal,
            is_room,
            entrance: None,
        };
        if is_room {
            for (cell, side) in inner_sides(briefing.goal) {
                knowledge.map.set(cell, side, Wall::Open);
            }
        }
        knowledge.count_shapes();
        knowledge
    }

    /// The wall map.
    pub const fn map(&self) -> &Map {
        &self.map
    }

    /// The uncertainty of a cell: how many shapes it may have. 1 when its shape is
    /// known; 0 when it turns out to be closed on all sides.
    pub fn uncertainty(&self, cell: Cell) -> u8 {
        self.shapes[(cell.y * self.map.dimension() + cell.x) as usize]
    }

    /// The cell of the goal behind its entrance, once an entrance is known.
    pub const fn entrance(&self) -> Option<Cell> {
        self.entrance
    }

    /// Enters a reading into both maps.
    pub fn observe(&mut self, pose: Pose, sensors: Sensors) {
        self.map.observe(pose, sensors);
        self.count_shapes();
        if self.entrance.is_none() && self.find_entrance() {
            self.count_shapes();
        }
    }

    /// Counts the shapes of every cell anew. No cell is closed on all four sides, so
    /// behind three walls the fourth side is open.
    fn count_shapes(&mut self) {
        let dimension = self.map.dimension();
        // Column by column, as the report's lists are.
        for cell in Area::new(Cell::new(0, 0), dimension, dimension).cells() {
            let sides = Heading::ALL.map(|side| self.map.wall(cell, side));
            let count = |wanted| sides.iter().filter(|&&wall| wall == wanted).count();
            let shapes = match (count(Wall::Unknown), count(Wall::Closed)) {
                (1, 3) => {
                    let open = sides.iter().position(|&wall| wall == Wall::Unknown);
                    let side = Heading::ALL[open.expect("one of them is unknown")];
                    self.map.set(cell, side, Wall::Open);
                    1
                }
                (unknown, _) => {
                    let all_closed = u8::from(count(Wall::Open) == 0);
                    ((1 << unknown) - all_closed).min(self.most_shapes(cell))
                }
            };
            self.shapes[(cell.y * dimension + cell.x) as usize] = shapes;
        }
    }

    /// How many shapes the report gives a cell before anything is seen.
    fn most_shapes(&self, cell: Cell) -> u8 {
        let at_edge = |it: u32| it == 0 || it == self.map.dimension() - 1;
        match (at_edge(cell.x), at_edge(cell.y)) {
            (true, true) => 2,
            (true, false) | (false, true) => 7,
            // Both walls, or one of the two.
            _ if self.is_room && self.goal.contains(cell) => 3,
            _ => 15,
        }
    }

    /// The goal room has one entrance: seven walls tell where it is, and it tells
    /// where the seven walls are. Of another goal only an opening that has been seen
    /// tells anything. True when an entrance has been found.
    fn find_entrance(&mut self) -> bool {
        let sides: Vec<Side> = outer_sides(self.goal).collect();
        let of = |wanted| {
            let map = &self.map;
            let is_wanted = move |side: &&Side| map.wall(side.0, side.1) == wanted;
            sides.iter().filter(is_wanted)
        };
        let entrance = match of(Wall::Open).next() {
            None if self.is_room && of(Wall::Closed).count() == 7 => of(Wall::Unknown).next(),
            open => open,
        };
        let entrance = entrance.copied();
        let Some(entrance) = entrance else {
            return false;
        };
        for side in sides.into_iter().filter(|_| self.is_room) {
            let is_open = side == entrance;
            let wall = if is_open { Wall::Open } else { Wall::Closed };
            self.map.set(side.0, side.1, wall);
        }
        self.entrance = Some(entrance.0);
        true
    }
}

fn inner_sides(room: Area) -> impl Iterator<Item = Side> {
    sides(room).filter(move |&side| is_inside(room, side))
}

fn outer_sides(room: Area) -> impl Iterator<Item = Side> {
    sides(room).filter(move |&side| !is_inside(room, side))
}

fn sides(room: Area) -> impl Iterator<Item = Side> {
    room.cells()
        .flat_map(|cell| Heading::ALL.map(|side| (cell, side)))
}

fn is_inside(room: Area, (cell, side): Side) -> bool {
    cell.toward(side, 1)
        .is_some_and(|beyond| room.contains(beyond))
}

#[cfg(test)]
mod tests {
    use super::*;
    use wasmouse_sdk::testing::{PlayOptions, briefing};

    fn knowledge(dimension: u32) -> Knowledge {
        Knowledge::new(&briefing(dimension, &PlayOptions::default()))
    }

    /// The report's numbers: 15 inside, 7 at edges, 2 in corners, 3 in the goal.
    #[test]
    fn initial_uncertainties() {
        for dimension in [4, 12, 16, 64] {
            let knowledge = knowledge(dimension);
            let last = dimension - 1;
            for cell in Area::new(Cell::new(0, 0), dimension, dimension).cells() {
                let edges = [cell.x, cell.y].map(|it| it == 0 || it == last);
                let expected = match edges {
                    [true, true] => 2,
                    [false, false] if Area::center(dimension).contains(cell) => 3,
                    [false, false] => 15,
                    _ => 7,
                };
                assert_eq!(knowledge.uncertainty(cell), expected, "{cell:?}");
            }
        }
    }

    #[test]
    fn a_goal_elsewhere_is_no_room() {
        let options = PlayOptions {
            goal: Some(Area::new(Cell::new(2, 2), 2, 2)),
            ..PlayOptions::default()
        };
        let knowledge = Knowledge::new(&briefing(12, &options));
        assert_eq!(knowledge.uncertainty(Cell::new(2, 2)), 15);
        let wall = knowledge.map().wall(Cell::new(2, 2), Heading::Up);
        assert_eq!(wall, Wall::Unknown);
    }

    /// The first reading of maze 01: every side edge of the left column is open, and
    /// each of its cells keeps one unknown wall, to the right.
    #[test]
    fn uncertainty_follows_the_walls() {
        let mut knowledge = knowledge(12);
        let first = Sensors {
            left: 0,
            front: 11,
            right: 0,
        };
        knowledge.observe(Pose::at_start(Cell::new(0, 0)), first);
        assert_eq!(knowledge.uncertainty(Cell::new(0, 0)), 1);
        for y in 1..11 {
            assert_eq!(knowledge.uncertainty(Cell::new(0, y)), 2);
        }
        // The wall to the right of the start is one of this cell's.
        assert_eq!(knowledge.uncertainty(Cell::new(1, 0)), 3);
        assert_eq!(knowledge.uncertainty(Cell::new(1, 1)), 15);
    }

    #[test]
    fn behind_three_walls_the_fourth_side_is_open() {
        let mut knowledge = knowledge(12);
        let dead_end = Cell::new(3, 4);
        for side in [Heading::Up, Heading::Left, Heading::Down] {
            knowledge.map.set(dead_end, side, Wall::Closed);
        }
        knowledge.count_shapes();
        assert_eq!(knowledge.uncertainty(dead_end), 1);
        assert_eq!(knowledge.map().wall(dead_end, Heading::Right), Wall::Open);
        // All four in a maze that breaks the rules: no shape is left.
        knowledge.map.set(dead_end, Heading::Right, Wall::Closed);
        knowledge.count_shapes();
        assert_eq!(knowledge.uncertainty(dead_end), 0);
    }

    /// From the one opening follow the seven walls, and the other way round.
    #[test]
    fn goal_inference() {
        let room = Area::center(12);
        for entrance in outer_sides(room) {
            for seven_walls in [false, true] {
                let mut knowledge = knowledge(12);
                for side in outer_sides(room) {
                    if seven_walls && side != entrance {
                        assert!(!knowledge.find_entrance());
                        knowledge.map.set(side.0, side.1, Wall::Closed);
                    }
                }
                if !seven_walls {
                    knowledge.map.set(entrance.0, entrance.1, Wall::Open);
                }
                assert!(knowledge.find_entrance());
                knowledge.count_shapes();
                assert_eq!(knowledge.entrance(), Some(entrance.0));
                for (cell, side) in outer_sides(room) {
                    let expected = if (cell, side) == entrance {
                        Wall::Open
                    } else {
                        Wall::Closed
                    };
                    assert_eq!(knowledge.map().wall(cell, side), expected);
                }
                for cell in room.cells() {
                    assert_eq!(knowledge.uncertainty(cell), 1);
                }
            }
        }
    }
}
