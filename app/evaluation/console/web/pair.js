// A page on another machine: the six digits, then the page that was asked for.

const form = document.getElementById("pair");
const digits = document.getElementById("digits");
const told = document.getElementById("told");

form.addEventListener("submit", async (event) => {
  event.preventDefault();
  told.textContent = "";
  try {
    const answer = await fetch("/pair", { method: "POST", headers: { "X-Molar": "1" }, body: digits.value });
    if (answer.ok) return location.reload();
    told.textContent = (await answer.text()).trim() || "These are not the digits.";
  } catch {
    told.textContent = "The station does not answer.";
  }
  digits.value = "";
  digits.focus();
});
