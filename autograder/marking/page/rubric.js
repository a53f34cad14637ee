// The rows of the rubric with their points, the comment, and what was said before.
import { element, points } from "./elements.js";

export function rubric(proof, first, does) {
  const given = proof.rows.map((row, at) => first.given?.[at] ?? 0);
  let edits = 0, savedEdits = 0; // what is typed while a save is on its way is not in it
  const isTouched = () => edits !== savedEdits;

  const touch = () => { edits += 1; refresh(); };
  const give = (at, number) => {
    given[at] = number;
    total.value = ""; // points for the whole are typed after the rows
    touch();
  };
  const ticks = proof.rows.map((row, at) => element("input", { type: "checkbox", on: {
    change: (event) => give(at, event.target.checked ? row.points : 0) } }));
  const parts = proof.rows.map((row, at) => element("input", { type: "number", min: 0, max: row.points, step: "any",
    "aria-label": `Points for row ${at + 1}`, on: {
      input: (event) => give(at, Number(event.target.value)) } }));
  const rows = proof.rows.map((row, at) => element("li", {},
    element("label", {}, ticks[at], " ", element("kbd", {}, `${at + 1}`), " ",
      element("span", { className: "rendered_html", html: row.text })),
    element("span", { className: "points" }, parts[at], ` of ${points(row.points)}`,
      first.suggested.includes(at + 1) ? element("em", {}, " suggested by the lines") : "")));

  const total = element("input", { type: "number", min: 0, max: proof.points, step: "any", id: "total", on: { input: touch } });
  const comment = element("textarea", { id: "comment", rows: 3, on: { input: touch } });
  const used = element("ul", { className: "used" });
  const save = element("button", { className: "save", on: { click: does.save } });
  const back = element("button", { on: { click: does.takeBack } }, "Back to those to be marked");

  const sum = () => Math.round(100 * given.reduce((all, one) => all + one, 0)) / 100;
  const all = () => (total.value === "" ? sum() : Number(total.value));

  function refresh() {
    proof.rows.forEach((row, at) => {
      ticks[at].checked = given[at] >= row.points;
      ticks[at].indeterminate = given[at] > 0 && given[at] < row.points;
      if (document.activeElement !== parts[at]) parts[at].value = given[at];
    });
    total.placeholder = proof.rows.length ? points(sum()) : "";
    save.replaceChildren(`Save ${points(all())} of ${points(proof.points)} points `, element("kbd", {}, "s"));
    shown.classList.toggle("touched", isTouched());
  }

  function add(text) {
    comment.value = [comment.value.trim(), text].filter(Boolean).join("\n\n");
    touch();
  }

  const shown = element("section", { className: "rubric", "aria-label": "Points" },
    element("h2", {}, "Points"),
    element("p", { className: "buttons" }, save, " ",
      element("button", { on: { click: does.next } }, "Next ", element("kbd", {}, "n")), " ",
      element("button", { on: { click: does.previous } }, "Previous ", element("kbd", {}, "p")), " ", back),
    proof.fault ? element("p", { className: "fault" }, proof.fault) : "",
    rows.length ? element("ol", {}, ...rows) : element("p", {}, "The problem's text has no table of points."),
    element("p", { className: "total" }, element("label", { htmlFor: "total" },
      rows.length ? "Other points for the whole " : "Points for the whole "), total, ` of ${points(proof.points)}`),
    element("p", {}, element("label", { htmlFor: "comment" }, "Comment ", element("kbd", {}, "c")), comment),
    element("div", { className: "before" }, element("h3", {}, "Said before"), used),
    element("p", { className: "help" }, element("kbd", {}, "1"), "–", element("kbd", {}, "9"), " tick rows, ",
      element("kbd", {}, "0"), " none of them, ", element("kbd", {}, "m"), " the model answer"));

  return {
    shown,
    sum,
    given: () => ({ given, total: total.value === "" && rows.length ? null : Number(total.value), comment: comment.value }),
    isTouched,
    edits: () => edits,
    toggle: (row) => give(row, given[row] >= proof.rows[row].points ? 0 : proof.rows[row].points),
    none() { given.fill(0); total.value = rows.length ? "" : 0; touch(); },
    toComment() { comment.focus(); },
    saved(answer, upTo = edits) {
      savedEdits = upTo;
      if (answer === first || !shown.dataset.filled) {
        const by = answer.given ? sum() : null;
        total.value = answer.points !== null && answer.points !== by ? answer.points : "";
        comment.value = answer.comment;
        shown.dataset.filled = "yes";
      }
      back.hidden = answer.state !== "marked";
      const again = answer.comments ?? proof.comments;
      used.replaceChildren(...again.map((text) => element("li", {},
        element("button", { on: { click: () => add(text) } }, text))));
      used.parentElement.hidden = !again.length;
      refresh();
    },
  };
}
