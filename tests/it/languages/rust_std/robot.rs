//! The flood robot, with what the standard library offers on WASI beside it: all of it has an
//! answer, and none of it changes how the robot drives.

mod flood;

use std::collections::HashMap;
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use flood::Flood;
use wasmouse_sdk::{Action, Briefing, Robot, Sensors, export_robot};

struct Std {
    flood: Flood,
    steps: HashMap<u32, u32>,
    began: Instant,
}

export_robot!(Std);

impl Robot for Std {
    fn start(briefing: &Briefing) -> Self {
        println!("variant {}", briefing.variant);
        eprintln!(
            "{} arguments, {} variables",
            std::env::args().count(),
            std::env::vars().count()
        );
        match briefing.variant {
            0 => {}
            1 => std::process::exit(3),
            2 => {
                let table: HashMap<&str, u32> = HashMap::new();
                println!("{}", table["missing"]);
            }
            3 => match std::net::TcpStream::connect("127.0.0.1:80") {
                Ok(_) => println!("connected"),
                Err(error) => println!("no network: {:?}", error.kind()),
            },
            _ => panic!("this robot has the variants 0 to 3"),
        }
        let reading = std::fs::read_to_string("maze.txt").expect_err("there are no files");
        let writing = std::fs::write("/tmp/notes.txt", "notes").expect_err("there are no files");
        println!(
            "reading: {:?}, writing: {:?}",
            reading.kind(),
            writing.kind()
        );
        let began = Instant::now();
        thread::sleep(Duration::from_secs(60));
        println!("slept for {} s", began.elapsed().as_secs());
        let year = SystemTime::now()
            .duration_since(SystemTime::UNIX_EPOCH)
            .expect("after 1970");
        println!("{} years after 1970", year.as_secs() / (365 * 24 * 3600));
        let numbers: HashMap<u32, ()> = (0..8).map(|number| (number, ())).collect();
        let order: Vec<String> = numbers.keys().map(u32::to_string).collect();
        println!("order {}", order.join(" "));
        Self {
            flood: Flood::start(&Briefing {
                variant: 0,
                ..*briefing
            }),
            steps: HashMap::new(),
            began,
        }
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        *self.steps.entry(sensors.front).or_insert(0) += 1;
        assert!(self.began.elapsed() > Duration::ZERO);
        self.flood.next_move(sensors)
    }
}
