//! Invalid files in the formats that are pictures: competition, map and blocks.

use super::*;

#[test]
fn invalid_pictures() {
    // Text to replace once, its replacement, the message for posts `o`.
    let invalid = [
        "|       |",
        "|       x",
        "line 4, column 9: expected `|` or a space, found `x`",
        "+   +---+",
        "+   x---+",
        "line 3, column 5: expected a post `o`, found `x`",
        "+   +---+",
        "+   +-- +",
        "line 3, column 8: expected `-` like the character before, found a space",
        "+   +---+",
        "+ - +---+",
        "line 3, column 3: expected a space like the character before, found `-`",
        "+   +---+",
        "+   +=--+",
        "line 3, column 6: expected `-` or a space, found `=`",
        "|           |",
        "            |",
        "line 2, column 1: expected `|` (the perimeter is closed), found a space",
        "|           |",
        "|            ",
        "line 2, column 13: expected `|` (the perimeter is closed), found a space",
        "|           |",
        "|          ",
        "line 2, column 12: expected a space, found the end of the line",
        "|           |",
        "|           | ",
        "line 2, column 14: expected the end of the line after 3 cells, found ` `",
        "|           |",
        "|X          |",
        "line 2, column 2: expected a space, found `X`",
        "|           |",
        "| X         |",
        "line 2, column 3: expected a space, `S` or `G`, found `X`",
        "|           |",
        "| \u{8}         |",
        "line 2, column 3: expected a space, `S` or `G`, found `\\u{8}`",
        "|           |",
        "| S   S     |",
        "line 2, column 7: second start `S`, the first is at (0, 2)",
        "|           |",
        "| G       G |",
        "the 2 goal cells do not fill a rectangle: (0, 2), (2, 2)",
        "|   |       |",
        "| G |       |",
        "start (0, 0) is in the goal",
        "+---+---+---+\n|   ",
        "+---+---+   +\n|   ",
        "line 1, column 10: expected `-` (the perimeter is closed), found a space",
        "+---+---+---+\n|   ",
        "+---+---+---+-\n|   ",
        "line 1, column 15: expected a whole number of cells, four characters each, and a post, found the end of the line",
        "+---+---+---+\n|   ",
        "+---+---+\n|   ",
        "the maze has 2 columns and 3 rows of cells, but must be square",
        "+---+   +   +\n|   |       |\n+---+---+---+\n",
        "",
        "line 5: expected a row of posts and walls, found the end of the text",
        "|   |       |\n+---+---+---+\n",
        "",
        "the maze has 3 columns and 2 rows of cells, but must be square",
    ];
    for [good, change, message] in invalid.as_chunks().0 {
        let competition = MAP.replacen(good, change, 1).replace('+', "o");
        check(&competition, Err(message));
    }
    let picture = MAP.replace('+', "o");
    let after = "line 8, column 1: expected the end of the text after 3 rows of cells, found ";
    check(
        &format!("{picture}by A. Mouse"),
        Err(&format!("{after}`b...`")),
    );
    check(
        &format!("{picture}by\nA. Mouse"),
        Err(&format!("{after}`b...`")),
    );
    check(
        &format!("{picture}{picture}"),
        Err(&format!("{after}`o...`")),
    );
    let row = "o---o---o---o\n|           |\n";
    let taller = format!("{row}{row}{picture}");
    check(
        &taller,
        Err("the maze has 3 columns and 5 rows of cells, but must be square"),
    );
    let map = MAP.replacen("+   +---+", "+ - +---+", 1);
    check(
        &map,
        Err("line 3, column 3: expected a space like the character before, found `-`"),
    );
    let map = MAP.replacen("+   +---+", "+   \t---+", 1);
    check(&map, Err("line 3, column 5: expected a post, found `\\t`"));
    for cells in [1, 65, 20_000] {
        check(
            &format!("o{}", "---o".repeat(cells)),
            Err(&format!(
                "maze size {cells} is outside the supported range of 2 to 64 cells"
            )),
        );
    }
}

#[test]
fn invalid_blocks() {
    // Text to replace once, its replacement, the message.
    let invalid = [
        "1011101",
        "1001101",
        "line 3, column 3: expected `1` (a post), found `0`",
        "1000101",
        "1100101",
        "line 4, column 2: expected `0` (a cell is open), found `1`",
        "1011101",
        "10x1101",
        "line 3, column 3: expected `1` (a post), found `x`",
        "1011101",
        "10 1101",
        "line 3, column 3: expected `1` (a post), found a space",
        "1011101",
        "1211101",
        "line 3, column 2: expected `1` or `0`, found `2`",
        "1000101",
        "10\u{7}0101",
        "line 4, column 3: expected `1` or `0`, found `\\u{7}`",
        "1011101",
        "0011101",
        "line 3, column 1: expected `1` (the perimeter is closed), found `0`",
        "1000101",
        "1000100",
        "line 4, column 7: expected `1` (the perimeter is closed), found `0`",
        "1111111",
        "1101111",
        "line 1, column 3: expected `1` (the perimeter is closed), found `0`",
        "1010001\n1111111",
        "1010001\n1111110",
        "line 7, column 7: expected `1` (the perimeter is closed), found `0`",
        "1000101",
        "100010",
        "line 4, column 7: expected `1` (the perimeter is closed), found the end of the line",
        "1011101",
        "101110",
        "line 3, column 7: expected `1` (the perimeter is closed), found the end of the line",
        "1000101",
        "10001010",
        "line 4, column 8: expected the end of the line after 3 cells, found `0`",
        "1111111\n1000001",
        "11111111\n1000001",
        "line 1, column 9: expected a whole number of cells, two characters each, and a wall, \
             found the end of the line",
        "1010001\n1111111\n",
        "1010001\n1111111\nMilestone 3",
        "line 8, column 1: expected the end of the text after 3 rows of cells, found `M...`",
        "1010001\n1111111\n",
        "1010001\n",
        "line 7: expected a row of walls, found the end of the text",
        "1010001\n1111111\n",
        "",
        "the maze has 3 columns and 2 rows of cells, but must be square",
    ];
    for [good, change, message] in invalid.as_chunks().0 {
        check(&BLOCKS.replacen(good, change, 1), Err(message));
    }
    // The example of the report.
    check(
        "11111\n10001\n11101\n10001\n10101\n10101\n11111",
        Err("the maze has 2 columns and 3 rows of cells, but must be square"),
    );
    check(
        "11111\n10001\n10101\n10001\n11111",
        Err("start (0, 0) is in the goal"),
    );
    for cells in [65, 20_000] {
        check(
            &"1".repeat(2 * cells + 1),
            Err(&format!(
                "maze size {cells} is outside the supported range of 2 to 64 cells"
            )),
        );
    }
    // Too short for blocks, so it is taken as a size.
    check(
        "111\n101\n111",
        Err("line 1, column 1: expected a maze size from 2 to 64, found `111`"),
    );
}
