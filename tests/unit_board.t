#!/bin/sh
# The unit tests on the board, and the tests of the board itself.
# shellcheck disable=SC2086 # A command line.
exec timeout 1200 ${BOARD_RUN-} "${UNIT_IMAGE:?run by make test}" </dev/null
