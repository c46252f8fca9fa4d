//! Small quadratic programs, as a step of the inverse kinematics poses them, with limits that bind.

use std::ffi::c_int;
use std::rc::Rc;
use std::time::Instant;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SupportedConeT, ZeroConeT};
use fastrand::Rng;
use uam::control::qp::{FREE, Outcome, Place, Places, Problem, Solution, solve};

use crate::library::{function, open};
use crate::measure::{Candidate, Contest, fastest};

/// The path's two directions.
const EQUATIONS: usize = 2;
/// Different problems.
const COUNT: usize = 500;
/// All problems, so many times in a round.
const TIMES: u32 = 10;
/// Weight of the smallest rates beside the moment.
const RIDGE: f64 = 1e-2;
/// Interior-point methods are slow: so many of the problems.
const CLARABEL: usize = 50;

/// A problem as every solver wants it.
#[derive(Clone)]
struct Case {
    path: [Vec<f64>; EQUATIONS],
    velocity: [f64; EQUATIONS],
    moment: Vec<f64>,
    value: f64,
    limits: Vec<f64>,
    /// For our solver.
    problem: Problem,
    places: Places,
}

/// Numbers from -1 to 1.
struct Random(Rng);

impl Random {
    fn number(&mut self) -> f64 {
        2.0 * self.0.f64() - 1.0
    }

    fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A problem whose path can be followed within the limits.
fn case(random: &mut Random, n: usize) -> Case {
    let path = [random.numbers(n), random.numbers(n)];
    let moment = random.numbers(n);
    let limits: Vec<f64> = random.numbers(n).iter().map(|number| 0.5 + 0.5 * number.abs()).collect();
    let possible: Vec<f64> = limits.iter().map(|limit| 0.9 * limit * random.number()).collect();
    let velocity = [0, 1].map(|row| dot(&path[row], &possible));
    let value = 3.0 * random.number();
    let mut problem = Problem::new(n, RIDGE);
    for (row, value) in path.iter().zip(velocity) {
        problem.equalities.push(row, value).unwrap();
    }
    problem.objective.push(&moment, value).unwrap();
    for (i, &limit) in limits.iter().enumerate() {
        (problem.lower[i], problem.upper[i]) = (-limit, limit);
    }
    Case { path, velocity, moment, value, limits, problem, places: FREE }
}

/// Problems in which a limit binds.
fn cases(n: usize) -> Vec<Case> {
    let mut random = Random(Rng::with_seed(n as u64));
    let mut cases = Vec::with_capacity(COUNT);
    while cases.len() < COUNT {
        let mut case = case(&mut random, n);
        let Solution { places, outcome, .. } = solve(&case.problem, &FREE);
        if outcome == Outcome::Solved && places[..n].iter().any(|place| matches!(place, Place::Lower | Place::Upper)) {
            case.places = places;
            cases.push(case);
        }
    }
    cases
}

impl Case {
    fn hessian(&self, row: usize, column: usize) -> f64 {
        2.0 * (self.moment[row] * self.moment[column] + if row == column { RIDGE } else { 0.0 })
    }

    fn slope(&self) -> impl Iterator<Item = f64> {
        self.moment.iter().map(|moment| -2.0 * self.value * moment)
    }

    /// As `daqp.c` reads it.
    fn for_daqp(&self) -> Vec<f64> {
        let n = self.limits.len();
        let hessian = (0..n * n).map(|i| self.hessian(i / n, i % n));
        let lower = self.limits.iter().map(|limit| -limit).chain(self.velocity);
        let upper = self.limits.iter().copied().chain(self.velocity);
        hessian.chain(self.slope()).chain(self.path.iter().flatten().copied()).chain(lower).chain(upper).collect()
    }

    fn for_clarabel(&self) -> Clarabel {
        let n = self.limits.len();
        let columns = |rows: &dyn Fn(usize) -> Vec<(usize, f64)>, height: usize| {
            let (mut starts, mut places, mut values) = (vec![0], Vec::new(), Vec::new());
            for column in 0..n {
                for (row, value) in rows(column) {
                    places.push(row);
                    values.push(value);
                }
                starts.push(places.len());
            }
            CscMatrix::new(height, n, starts, places, values)
        };
        let constraint = |column: usize| {
            let path = (0..EQUATIONS).map(|row| (row, self.path[row][column]));
            path.chain([(EQUATIONS + column, 1.0), (EQUATIONS + n + column, -1.0)]).collect()
        };
        let upper = |column: usize| (0..=column).map(|row| (row, self.hessian(row, column))).collect();
        Clarabel {
            hessian: columns(&upper, n),
            slope: self.slope().collect(),
            constraints: columns(&constraint, EQUATIONS + 2 * n),
            right: self.velocity.iter().chain(&self.limits).chain(&self.limits).copied().collect(),
            cones: [ZeroConeT(EQUATIONS), NonnegativeConeT(2 * n)],
        }
    }
}

struct Clarabel {
    hessian: CscMatrix<f64>,
    slope: Vec<f64>,
    constraints: CscMatrix<f64>,
    right: Vec<f64>,
    cones: [SupportedConeT<f64>; 2],
}

impl Clarabel {
    fn solve(&self) -> Vec<f64> {
        let settings = DefaultSettings { verbose: false, ..DefaultSettings::default() };
        let Self { hessian, slope, constraints, right, cones } = self;
        let mut solver = DefaultSolver::new(hessian, slope, constraints, right, cones, settings).unwrap();
        solver.solve();
        solver.solution.x.clone()
    }
}

/// Largest distance of answers, one after the other, from those of our solver.
fn error(cases: &[Case], answers: &[f64]) -> f64 {
    let pairs = cases.iter().zip(answers.chunks(cases[0].limits.len()));
    let far = |(case, answer): (&Case, &[f64])| {
        let ours = solve(&case.problem, &FREE).x;
        answer.iter().zip(ours).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    pairs.map(far).fold(0.0, f64::max)
}

/// With as many variables as the arm has links.
pub fn contest(title: &'static str, n: usize) -> Contest<'static> {
    let cases = Rc::new(cases(n));
    let ours = |cases: &Rc<Vec<Case>>, warm: bool| {
        let cases = Rc::clone(cases);
        move || {
            fastest(TIMES, || {
                let begin = Instant::now();
                for case in cases.iter() {
                    std::hint::black_box(solve(&case.problem, if warm { &case.places } else { &FREE }));
                }
                begin.elapsed().as_secs_f64() / COUNT as f64
            })
        }
    };
    let mut candidates = vec![
        Candidate::new("our active set, nothing known before", None, ours(&cases, false)),
        Candidate::new("our active set, from the limits that bound last", None, ours(&cases, true)),
    ];
    if let Some(library) = open("daqp") {
        type Daqp = unsafe extern "C" fn(c_int, c_int, c_int, *const f64, c_int, *mut f64) -> c_int;
        // SAFETY: the type is that in daqp.c.
        let daqp: Daqp = unsafe { function(&library, "peers_daqp") };
        let numbers: Rc<Vec<f64>> = Rc::new(cases.iter().flat_map(Case::for_daqp).collect());
        let library = Rc::new(library);
        for (name, keep) in [
            ("DAQP, set-up and solution in memory that is kept", true),
            ("DAQP, set-up and solution in one call", false),
        ] {
            let (library, numbers) = (Rc::clone(&library), Rc::clone(&numbers));
            let mut answers = vec![0.0; COUNT * n];
            let mut run = move || {
                let _loaded = &library;
                // SAFETY: `numbers` holds COUNT problems, `answers` has room for their solutions.
                let failures =
                    unsafe { daqp(n as c_int, 2, COUNT as c_int, numbers.as_ptr(), keep.into(), answers.as_mut_ptr()) };
                assert_eq!(failures, 0, "DAQP fails");
                answers.clone()
            };
            let error = error(&cases, &run());
            candidates.push(Candidate::new(name, Some(error), move || {
                fastest(TIMES, || {
                    let begin = Instant::now();
                    run();
                    begin.elapsed().as_secs_f64() / COUNT as f64
                })
            }));
        }
    }
    let problems: Vec<Clarabel> = cases.iter().take(CLARABEL).map(Case::for_clarabel).collect();
    let answers: Vec<f64> = problems.iter().flat_map(Clarabel::solve).collect();
    candidates.push(Candidate::new("Clarabel, set-up and solution", Some(error(&cases, &answers)), move || {
        fastest(TIMES, || {
            let begin = Instant::now();
            for problem in &problems {
                std::hint::black_box(problem.solve());
            }
            begin.elapsed().as_secs_f64() / CLARABEL as f64
        })
    }));
    Contest { title, candidates }
}
