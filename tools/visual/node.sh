# SPDX-License-Identifier: MIT
# Sourced in tools/visual: puts the Node of build/venv (tools/dev/setup web) first, and ends where there is none that will do.
PATH=$(cd ../.. && pwd)/build/venv/bin:$PATH
node_version=$(node --version 2>/dev/null) || node_version=none
node_major=${node_version#v}
if [ "$node_version" = none ] || [ "${node_major%%.*}" -lt 24 ]; then
    echo "visual: Node $node_version is too old for the page, which needs 24: \`tools/dev/setup web\` puts that into build/venv" >&2
    exit 1
fi
# What Node has compiled is kept: every thread of the tests that runs a worker of the page would strip the same types anew.
NODE_COMPILE_CACHE=$(cd ../.. && pwd)/build/node-cache
export NODE_COMPILE_CACHE
