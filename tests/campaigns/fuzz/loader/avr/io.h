/* SPDX-License-Identifier: MIT
 * No registers: the code built here uses none. */
