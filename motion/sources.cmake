# SPDX-License-Identifier: MIT
# What plays pages, relative to the top: every image, test and harness that plays links one of these. SMALL, for Edit, has
# neither the classic law, nor blend and amplitude, nor layers.
set(M512_PLAYER_CORE motion/law_exact.c motion/link.c motion/page.c motion/player.c motion/sequence.c motion/shape.c
    motion/step_ticks.c)
set(M512_PLAYER_FULL ${M512_PLAYER_CORE} motion/law_classic.c motion/shape_step.c motion/layers.c motion/code_motion.c
    motion/mux.c)
set(M512_PLAYER_SMALL ${M512_PLAYER_CORE} motion/law_classic_none.c motion/shape_step_none.c)
