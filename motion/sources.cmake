# SPDX-License-Identifier: MIT
# What plays pages, relative to the top: every image, test and harness that plays links these. Beside them go
# shape_step.c or shape_step_none.c. SMALL, for Edit, leaves out the classic law and layers: it needs SMALL_DEFINES too.
set(M512_PLAYER_CORE motion/brake.c motion/exact_plan.c motion/law_exact.c motion/link.c motion/page.c motion/player.c
    motion/sequence.c motion/sequence_read.c motion/sequence_work.c motion/shape.c motion/step_plan.c)
set(M512_PLAYER_FULL ${M512_PLAYER_CORE} motion/law_classic.c motion/classic_plan.c motion/classic_pause.c
    motion/shape_step.c motion/layers.c motion/layers_code.c motion/layers_hand.c)
set(M512_PLAYER_SMALL ${M512_PLAYER_CORE} motion/shape_step_none.c)
set(M512_PLAYER_SMALL_DEFINES PLAYER_CLASSIC=0 PLAYER_LAYERS=0)
