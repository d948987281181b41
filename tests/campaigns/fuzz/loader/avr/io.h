/* SPDX-License-Identifier: MIT
 * No registers: what is built here uses none of them. */
