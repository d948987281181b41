# SPDX-License-Identifier: MIT
# From a file of Unity tests, the program that runs them: every `static void test_...(void)`, in their order.
# awk -v test=/path/test_x.c -f run_tests.awk /path/test_x.c > test_x_main.c
function quoted(text) { return "\"" text "\"" }
/^static void test_[A-Za-z0-9_]+\(void\)$/ {
    name = $3
    sub(/\(void\)/, "", name)
    runs = runs "#line " FNR " " quoted(test) "\n    RUN_TEST(" name ");\n"
}
/^void (setUp|tearDown)\(void\)/ { own[substr($2, 1, index($2, "(") - 1)] = 1 }
END {
    print "#include " quoted(test)
    # Strong ones are in the test, or in its stage.
    if (!own["setUp"]) print "__attribute__((weak)) void setUp(void) {}"
    if (!own["tearDown"]) print "__attribute__((weak)) void tearDown(void) {}"
    printf "int main(void)\n{\n    UnityBegin(%s);\n%s    return UnityEnd();\n}\n", quoted(test), runs
}
