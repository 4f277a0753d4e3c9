//! The scalars that training tunes: [`Parameters`].

/// What decides between driving, exploring and resetting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// What every unknown wall costs on the way to the goal, in steps.
    pub goal_price: f32,
    /// What it costs besides. Unit: steps for each unit of -ln of the chance that it is
    /// open.
    pub goal_caution: f32,
    /// The same for the paths from start to goal that are looked for afterwards.
    pub way_caution: f32,
    /// The power of the chance that such a path exists.
    pub doubt: f32,
    /// Steps of exploring that have to be gained, for each step to go and look.
    pub reluctance: f32,
    /// Steps that looking costs besides the path to the first wall.
    pub overhead: f32,
    /// See `Faith::factor`.
    pub faith_prior: f32,
}

impl Parameters {
    /// How many there are.
    pub const COUNT: usize = 7;

    /// In the order of the fields.
    pub const fn to_array(self) -> [f32; Self::COUNT] {
        [
            self.goal_price,
            self.goal_caution,
            self.way_caution,
            self.doubt,
            self.reluctance,
            self.overhead,
            self.faith_prior,
        ]
    }

    /// The other way round.
    pub const fn from_array(it: [f32; Self::COUNT]) -> Self {
        Self {
            goal_price: it[0],
            goal_caution: it[1],
            way_caution: it[2],
            doubt: it[3],
            reluctance: it[4],
            overhead: it[5],
            faith_prior: it[6],
        }
    }

    /// The mean of several, each with a weight; the weights add up to 1.
    pub fn mean(weighted: impl Iterator<Item = (f32, Self)>) -> Self {
        let mut sum = [0.0; Self::COUNT];
        for (weight, parameters) in weighted {
            let parts = sum.iter_mut().zip(parameters.to_array());
            parts.for_each(|(sum, it)| *sum += weight * it);
        }
        Self::from_array(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means() {
        let [low, high] = [1.0, 3.0].map(|first| {
            let fields = std::array::from_fn(|place| first + place as f32);
            Parameters::from_array(fields)
        });
        let mean = Parameters::mean([(0.75, low), (0.25, high)].into_iter());
        assert_eq!(mean.to_array(), [1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5]);
        assert_eq!((mean.goal_price, mean.faith_prior), (1.5, 7.5));
    }
}
