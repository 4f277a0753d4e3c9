//! What is written, read again.

use super::*;
use crate::report::raster::Image;

/// A dot that moves to the right on a ground with a shade for each column, and does not in the
/// last step.
fn frame(index: usize) -> Image {
    let place = 3 * index.min(4) as u32;
    let pixels = (0..8 * 20).map(|it| {
        let (x, y) = (it % 20, it / 20);
        if y == 3 && (place..place + 2).contains(&x) {
            [200, 0, 100]
        } else {
            [255, 255, x as u8]
        }
    });
    Image::new(20, pixels.collect())
}

const COUNT: usize = 6;
const TIMING: Timing = Timing {
    delay: 8,
    hold: 300,
};

fn frames<'a>(progress: &'a dyn Fn(usize) -> bool) -> Frames<'a> {
    Frames {
        count: COUNT,
        draw: &|index| Ok(frame(index)),
        progress,
    }
}

#[test]
fn gif_files_have_all_frames_and_nothing_twice() {
    let mut bytes = Vec::new();
    gif(&frames(&|_| true), TIMING, &mut bytes).expect("written");
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(bytes.as_slice()).expect("a GIF file");
    assert_eq!((decoder.width(), decoder.height()), (20, 8));
    let mut canvas = vec![[0; 3]; 160];
    let (mut delays, mut sizes) = (Vec::new(), Vec::new());
    for index in 0..COUNT {
        let it = decoder.read_next_frame().expect("valid").expect("a frame");
        delays.push(it.delay);
        sizes.push((it.width, it.height));
        for (place, color) in it.buffer.chunks(4).enumerate() {
            let (x, y) = (place as u16 % it.width, place as u16 / it.width);
            if color[3] > 0 {
                let at = usize::from(it.top + y) * 20 + usize::from(it.left + x);
                canvas[at] = [color[0], color[1], color[2]];
            }
        }
        assert_eq!(canvas, frame(index).pixels(), "frame {index}");
    }
    assert!(decoder.read_next_frame().expect("valid").is_none());
    assert_eq!(delays, [8, 8, 8, 8, 8, 300]);
    assert_eq!(sizes, [(20, 8), (5, 1), (5, 1), (5, 1), (5, 1), (1, 1)]);
}

#[test]
fn animated_png_files_have_exact_colours() {
    let mut bytes = Vec::new();
    apng(&frames(&|_| true), TIMING, &mut bytes).expect("written");
    let decoder = ::png::Decoder::new(std::io::Cursor::new(bytes));
    let mut reader = decoder.read_info().expect("a PNG file");
    let control = reader.info().animation_control().expect("animated");
    assert_eq!((control.num_frames, control.num_plays), (6, 0));
    let mut canvas = vec![[0; 3]; 160];
    for index in 0..COUNT {
        let mut bytes = vec![0; 160 * 4];
        let read = reader.next_frame(&mut bytes).expect("a frame");
        let place = reader.info().frame_control().expect("of an animation");
        let hundredths = if index == 5 { 300 } else { 8 };
        assert_eq!((place.delay_num, place.delay_den), (hundredths, 100));
        for (at, color) in bytes[..read.buffer_size()].chunks(4).enumerate() {
            let (x, y) = (at as u32 % place.width, at as u32 / place.width);
            if color[3] > 0 {
                let at = (place.y_offset + y) * 20 + place.x_offset + x;
                canvas[at as usize] = [color[0], color[1], color[2]];
            }
        }
        assert_eq!(canvas, frame(index).pixels(), "frame {index}");
    }
}

#[test]
fn what_is_too_large_or_cancelled_is_an_error() {
    let write = |count: usize, progress: &dyn Fn(usize) -> bool| {
        let frames = Frames {
            count,
            draw: &|index| Ok(frame(index)),
            progress,
        };
        let files = [
            gif(&frames, TIMING, &mut Vec::new()),
            apng(&frames, TIMING, &mut Vec::new()),
        ];
        files.map(|it| it.expect_err("no file").to_string())
    };
    let too_large = "20000000 frames of 20 x 8 pixels are too many; an animated picture has at \
                     most 2000000000 pixels in all frames together";
    assert_eq!(write(20_000_000, &|_| true), [too_large; 2]);
    assert_eq!(
        write(0, &|_| true),
        ["an animated picture without frames"; 2]
    );
    assert_eq!(write(COUNT, &|frames| frames < 3), ["interrupted"; 2]);
}
