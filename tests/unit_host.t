#!/bin/sh
# The unit tests on this machine, under the address and undefined-behaviour sanitizers.
exec timeout 120 "${UNIT_HOST:?run by make test}"
