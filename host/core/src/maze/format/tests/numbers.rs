//! Invalid files in the formats of numbers: Udacity and `num`.

use super::*;

#[test]
fn invalid_udacity_files() {
    let invalid = [
        "0",
        "line 1, column 1: expected a maze size from 2 to 64, found `0`",
        "1\n0",
        "line 1, column 1: expected a maze size from 2 to 64, found `1`",
        "65",
        "line 1, column 1: expected a maze size from 2 to 64, found `65`",
        "  999999999\n",
        "line 1, column 3: expected a maze size from 2 to 64, found `999999999`",
        "99999999999999999999999999999999\n",
        "line 1, column 1: expected a maze size from 2 to 64, found `9...`",
        "3\n3,5,6\n10,1,14",
        "line 4: expected the 3 values of column 2, found the end of the text",
        "3\n3,5,6\n10,1,14\n9,5,12\n1,2,3",
        "line 5, column 1: expected the end of the text after 3 columns, found `1...`",
        "3\n3,5\n10,1,14\n9,5,12",
        "line 2, column 4: expected 3 values, found the end of the line after 2",
        "3\n3,5,6, 7\n10,1,14\n9,5,12",
        "line 2, column 8: expected the end of the line after 3 values, found `7`",
        "3\n3,16,6\n10,1,14\n9,5,12",
        "line 2, column 3: expected a number from 0 to 15, found `16`",
        "3\n3,-1,6\n10,1,14\n9,5,12",
        "line 2, column 3: expected a number from 0 to 15, found `-1`",
        "3\n3,,6\n10,1,14\n9,5,12",
        "line 2, column 3: expected a number from 0 to 15, found nothing",
        "3\n3,é, \u{7}\n",
        "line 2, column 3: expected a number from 0 to 15, found `é`",
        "3\n3,5, \u{7}\n",
        "line 2, column 6: expected a number from 0 to 15, found `\\u{7}`",
        "3\n\n3,5,6\n",
        "line 2, column 1: expected a number from 0 to 15, found nothing",
        "3\n3,5,6\n10,1,14\n9,5,14",
        "1 invalid edge: the perimeter is open at (2, 2), right",
        "3\n3,5,6\n10,1,10\n9,5,12",
        "1 invalid edge: (1, 1) is open up but (1, 2) is closed down",
        "3\n15,15,15\n15,15,15\n0,15,15",
        "12 invalid edges: the perimeter is open at (0, 0), down, \
             the perimeter is open at (0, 0), left, \
             the perimeter is open at (0, 1), left, \
             the perimeter is open at (0, 2), up, \
             the perimeter is open at (0, 2), left, \
             (1, 0) is open right but (2, 0) is closed left, \
             the perimeter is open at (1, 0), down, \
             the perimeter is open at (1, 2), up and 4 more",
        "2\n3,6\n9,12",
        "start (0, 0) is in the goal",
    ];
    for [text, message] in invalid.as_chunks().0 {
        check(text, Err(message));
    }
}

#[test]
fn invalid_num_files() {
    let invalid = [
        "0 0 1 1 1 1",
        "maze size 1 is outside the supported range of 2 to 64 cells",
        "0 0 1 1 1",
        "line 1, column 10: expected the west wall (0 to 1), found the end of the line",
        "0 0 1 1 1 1 1",
        "line 1, column 13: expected the end of the line after six numbers, found `1`",
        "0  0 1 2 1 1",
        "line 1, column 8: expected the east wall (0 to 1), found `2`",
        "999999999 0 1 1 1 1",
        "line 1, column 1: expected the x of a cell (0 to 63), found `999999999`",
        "0 64 1 1 1 1",
        "line 1, column 3: expected the y of a cell (0 to 63), found `64`",
        "0 0 1 1 1 1\n0 x 1 1 1 1",
        "line 2, column 3: expected the y of a cell (0 to 63), found `x`",
        // The example in the README of mms.
        "0 0 0 1 1 1\n0 1 1 0 0 1\n1 0 0 0 1 1\n1 1 1 1 0 0\n2 0 0 1 1 0\n2 1 1 1 0 1",
        "the maze has 3 columns and 2 rows of cells, but must be square",
        "0 0 0 1 1 1\n1 1 1 1 0 0\n0 0 0 1 1 1",
        "line 3: second line for cell (0, 0), the first is line 1",
        "0 0 0 1 1 1\n1 1 1 1 0 0",
        "missing cells: (0, 1), (1, 0)",
        "0 0 1 1 1 1\n0 1 1 1 0 1\n1 0 1 1 1 1\n1 1 1 0 1 1",
        "2 invalid edges: (0, 0) is closed up but (0, 1) is open down, \
             the perimeter is open at (1, 1), right",
    ];
    for [text, message] in invalid.as_chunks().0 {
        check(text, Err(message));
    }
}
