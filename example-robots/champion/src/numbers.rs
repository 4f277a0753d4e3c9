//! Logarithm and exponential from basic arithmetic alone.
//!
//! The standard library's are those of the platform and may differ in the last bit;
//! a robot has to decide the same natively and in WebAssembly. Additions,
//! multiplications and divisions are the same everywhere.

/// The natural logarithm of `x`, which lies in 0.000001..=1. Right to about 1e-6.
pub fn ln(x: f32) -> f32 {
    const LN_2: f32 = std::f32::consts::LN_2;
    let (mut x, mut sum) = (x.max(1e-6), 0.0);
    while x < 0.75 {
        x *= 2.0;
        sum -= LN_2;
    }
    // ln x = 2 artanh((x - 1) / (x + 1)); x is in 0.75..1.5, so this converges fast.
    let y = (x - 1.0) / (x + 1.0);
    let square = y * y;
    let series = 1.0 + square * (1.0 / 3.0 + square * (1.0 / 5.0 + square * (1.0 / 7.0)));
    sum + 2.0 * y * series
}

/// e to the power of `x`, which is at most 0. Right to about 1e-4 of the result.
pub fn exp(x: f32) -> f32 {
    if x < -40.0 {
        return 0.0;
    }
    // e^x = (e^(x / 256))^256, and the inner one by its series.
    let y = x / 256.0;
    let mut power = 1.0 + y * (1.0 + y * (0.5 + y * (1.0 / 6.0 + y / 24.0)));
    for _ in 0..8 {
        power *= power;
    }
    power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_the_real_ones() {
        for step in 1..=1000u16 {
            let x = f32::from(step) / 1000.0;
            assert!((ln(x) - x.ln()).abs() < 1e-5, "ln {x}");
            let y = -x * 30.0;
            assert!((exp(y) / y.exp() - 1.0).abs() < 1e-3, "exp {y}");
        }
        assert_eq!(exp(-100.0), 0.0);
    }
}
