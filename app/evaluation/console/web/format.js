// Numbers as people read them, each with its unit; times as minutes and seconds.

/** 221.4 -> "03:41"; none: "–". */
export function minutes(s) {
  if (!Number.isFinite(s)) return "–";
  const whole = Math.max(0, Math.floor(s));
  return `${String(Math.floor(whole / 60)).padStart(2, "0")}:${String(whole % 60).padStart(2, "0")}`;
}

/** As above with thousandths, for the time of an open line. */
export function minutesExactly(s) {
  if (!Number.isFinite(s)) return "–";
  const ms = Math.max(0, Math.round(s * 1000));
  return `${minutes(ms / 1000)}.${String(ms % 1000).padStart(3, "0")}`;
}

/** At most `digits` after the point. */
export function number(value, digits = 2) {
  if (value === null || value === undefined || !Number.isFinite(Number(value))) return "–";
  return String(Number(Number(value).toFixed(digits))).replace("-", "−");
}

/** A value with its unit, three figures where it is small: "2.31 mm", "34.6 s", "180 mm³"; what counts has none. */
export function withUnit(value, unit, digits = Math.abs(value) < 10 ? 2 : Math.abs(value) < 100 ? 1 : 0) {
  const shown = number(value, digits);
  return unit && shown !== "–" ? `${shown} ${unit === "mm3" ? "mm³" : unit}` : shown;
}

export function severityName(severity) {
  return ["not a problem", "cosmetic", "minor", "major", "catastrophic"][severity] ?? "";
}
