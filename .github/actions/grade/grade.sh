#!/bin/sh
# The second step of the action: grades, and says in the output `exit-code` how that ended. It
# succeeds whatever the grade is, so that the reports are uploaded; the last step fails.
#
# RUBRIC, REPORTS  a file, a folder
# ROBOTS           one robot per line
# WASMOUSE         the program
set -eu

set --
while IFS= read -r robot; do
    [ -z "$robot" ] || set -- "$@" "$robot"
done <<END
$ROBOTS
END

code=0
"$WASMOUSE" grade "$RUBRIC" "$@" \
    --output-dir "$REPORTS" --force --step-summary --annotations || code=$?
echo "exit-code=$code" >>"$GITHUB_OUTPUT"
case $code in
    0 | 1 | 4) ;;
    *) echo "::error title=wasmouse::grading ended with exit code $code; the log says why" ;;
esac
