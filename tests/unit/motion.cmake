# SPDX-License-Identifier: MIT
# Pages, links, player, approach.
m512_unit_test(test_page TARGET_TOO SOURCES motion/page.c)
m512_unit_test(test_link TARGET_TOO SOURCES motion/link.c)
m512_unit_test(test_approach TARGET_TOO SOURCES motion/approach.c)
m512_unit_test(test_mul TARGET_TOO SOURCES motion/page.c)

# The same vectors judge the C codec and m512's.
m512_unit_test(test_page_vectors SOURCES motion/page.c)
if(TARGET test_page_vectors)
    set(vectors ${CMAKE_SOURCE_DIR}/tests/golden/page_vectors)
    add_custom_command(OUTPUT page_vectors.h
        COMMAND ${M512_PYTHON} ${vectors}_table.py ${vectors}.json ${CMAKE_CURRENT_BINARY_DIR}/page_vectors.h
        DEPENDS ${vectors}_table.py ${vectors}.json)
    target_sources(test_page_vectors PRIVATE page_vectors.h)
    target_include_directories(test_page_vectors PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endif()

set(player_sources motion/player.c motion/law_exact.c motion/law_classic.c motion/classic_ahead.c motion/brake.c motion/step_plan.c motion/link.c motion/page.c)
m512_unit_test(test_player TARGET_TOO SOURCES ${player_sources} tests/unit/sparse_pages.c INCLUDES tests/unit)
m512_unit_test(test_player_brake TARGET_TOO SOURCES ${player_sources} tests/unit/sparse_pages.c INCLUDES tests/unit)
m512_unit_test(test_player_exact SOURCES ${player_sources} tests/unit/sparse_pages.c INCLUDES tests/unit)
if(TARGET test_player_exact)
    target_link_libraries(test_player_exact PRIVATE m)
endif()
m512_unit_test(test_player_golden SOURCES ${player_sources} tests/unit/image_source.c INCLUDES tests/unit)
if(TARGET test_player_golden)
    target_compile_definitions(test_player_golden PRIVATE GOLDEN_DIR="${CMAKE_SOURCE_DIR}/tests/golden")
endif()
m512_unit_test(test_player_images SOURCES ${player_sources} tests/unit/image_source.c INCLUDES tests/unit)
if(TARGET test_player_images)
    target_compile_definitions(test_player_images PRIVATE SOURCE_DIR="${CMAKE_SOURCE_DIR}")
    target_link_libraries(test_player_images PRIVATE m)
endif()
m512_unit_test(test_page_format SOURCES motion/page.c)
if(TARGET test_page_format)
    target_compile_definitions(test_page_format PRIVATE PAGE_FORMAT_MD="${CMAKE_SOURCE_DIR}/motion/PAGE_FORMAT.md")
endif()
