// The page for marking: a list of the answers that a person reads, one answer beside its rubric, and the
// answers on which two markers differ. What the server sends as HTML has been cleaned there.
import { element, field, points, typed } from "./elements.js";
import { rubric } from "./rubric.js";

const page = document.getElementById("page");
const said = document.getElementById("said");
let leave = null; // asks the view to save, before another one is shown
let keys = null; // what a key does in this view
let shown = "";
let busy = false;
let arrived = () => {};

const [, token] = location.hash.match(/token=([\w-]+)/) ?? [];
if (token) {
  sessionStorage.setItem("token", token);
  const [, to] = location.hash.match(/to=([^&]+)/) ?? [, ""];
  history.replaceState(null, "", `#${to}`);
}

const path = (...parts) => parts.map(encodeURIComponent).join("/");
const link = (where, ...children) => element("a", { href: `#${where}` }, ...children);

async function ask(name, wanted, body) {
  const options = { headers: { Authorization: `token ${sessionStorage.getItem("token")}` } };
  if (body) Object.assign(options, { method: "POST", body: JSON.stringify(body) });
  let answer;
  try {
    answer = await fetch(`api/${name}?${new URLSearchParams(wanted)}`, options);
  } catch {
    throw new Error("The server does not answer: is `autograder mark` still running?");
  }
  const found = await answer.json();
  if (!answer.ok) throw Object.assign(new Error(found.error), { hasChanged: answer.status === 409 });
  return found;
}

const get = (name, wanted = {}) => ask(name, wanted);
const act = (name, body) => ask(name, {}, body);

// way: what may be done about it, as the words of a button and what it does.
function say(text, isError = false, way = null) {
  said.replaceChildren(text, ...(way ? [" ", element("button", { on: { click: safely(way[1]) } }, way[0])] : []));
  said.classList.toggle("error", isError);
}

const safely = (does) => async (...given) => {
  try {
    return await does(...given);
  } catch (error) {
    say(error.message, true, error.way);
    return undefined;
  }
};

// One at a time: a second press, while the first one still saves, would save over what it has not seen.
const alone = (does) => async () => {
  if (busy) return;
  busy = true;
  await safely(does)();
  busy = false;
};

// Resolves when the view is there.
const goTo = (where) => new Promise((done) => {
  arrived = done;
  location.hash = where;
});

async function list() {
  const proofs = await get("proofs");
  document.title = "Marking";
  const rows = proofs.map((one) => {
    const where = path(one.assignment, one.cell);
    const apart = one.apart ? `${one.apart} to decide` : "";
    return element("tr", {},
      element("th", { scope: "row" }, link(`mark/${where}`, element("span", { html: one.title }))),
      element("td", {}, one.assignment),
      element("td", { className: "number" }, `${one.answers}`),
      element("td", { className: "number left" }, one.left ? `${one.left}` : one.answers ? "none" : ""),
      element("td", { className: "number" }, one.blank ? `${one.blank}` : ""),
      element("td", {}, one.second ? "" : link(`apart/${where}`, apart || "compare")));
  });
  const heads = ["what a person reads", "assignment", "answers", "left to mark", "blank", "two markers"];
  const head = element("tr", {}, ...heads.map((text) => element("th", { scope: "col" }, text)));
  page.replaceChildren(element("h1", {}, proofs[0]?.second ? "Marking, as the second" : "Marking"),
    proofs.length
      ? element("table", { className: "list" }, element("thead", {}, head), element("tbody", {}, ...rows))
      : element("p", {}, "No assignment in the gradebook has an answer that a person reads."));
}

// unsaved: a comment that was not saved, which is offered.
async function marking(assignment, cell, wanted, unsaved = "") {
  const proof = await get("proof", { assignment, cell });
  const isLeft = (one) => one.state !== "marked";
  if (!proof.papers.length) {
    page.replaceChildren(link("", "All answers"), element("p", {},
      `There is nothing to read: nobody has written anything here, or “autograder grade ${assignment}” has not run yet.`));
    return;
  }
  const found = proof.papers.findIndex((one) => one.id === wanted);
  const at = found >= 0 ? found : Math.max(proof.papers.findIndex(isLeft), 0);
  const paper = proof.papers[at];
  const here = `#mark/${path(assignment, cell, paper.id)}`; // where a reload leads
  history.replaceState(null, "", here);
  shown = here;
  if (unsaved) proof.comments.unshift(unsaved);
  let answer = await get("answer", { assignment, cell, id: paper.id });
  let showsModel = sessionStorage.getItem("model") !== "hidden";

  const where = element("p", { className: "where" });
  const heading = element("h1", { html: proof.title });
  const state = element("span", { className: "state" });
  const model = element("section", { className: "model", "aria-label": "The model answer" },
    element("h2", {}, "The model answer"), element("div", { className: "rendered_html", html: proof.model }));
  const fold = (title, html) => element("details", {}, element("summary", {}, title),
    element("div", { className: "rendered_html", html }));
  const read = element("section", { className: "answer", "aria-label": "The answer" },
    element("h2", {}, answer.student || "The answer", " ", state),
    answer.fault ? element("p", { className: "fault" }, answer.fault) : "",
    element("div", { html: answer.answer }),
    answer.beside.trim() ? element("div", { className: "beside" }, element("h2", {}, "Handed in beside it"),
      element("div", { html: answer.beside })) : "",
    fold("The rest of this notebook", answer.rest));

  const panel = rubric(proof, answer, { save: alone(save), takeBack: alone(takeBack), next: alone(next),
    previous: alone(previous) });
  const go = (one) => goTo(`#mark/${path(assignment, cell, one.id)}`);

  function told() {
    const left = proof.papers.filter(isLeft).length;
    where.replaceChildren(link("", "All answers"), ` · ${assignment} · answer ${at + 1} of ${proof.papers.length} · `,
      element("strong", {}, left ? `${left} left to mark` : "all are marked"));
    state.textContent = answer.state;
    state.className = `state ${answer.state === "marked" ? "done" : ""}`;
    document.title = `${left} left · ${assignment}`;
  }

  async function change(name, more) {
    const upTo = panel.changes();
    let now;
    try {
      now = await act(name, { assignment, cell, id: paper.id, version: answer.version, ...more });
    } catch (error) {
      throw error.hasChanged ? Object.assign(error, { way: ["Open it again", reopen] }) : error;
    }
    answer = { ...answer, ...now };
    paper.state = now.state;
    panel.saved(answer, upTo);
    told();
  }

  async function reopen() {
    const { comment } = panel.given();
    const offered = panel.isTouched() && comment !== answer.comment ? comment : "";
    await marking(assignment, cell, paper.id, offered);
    say(`This is what it has now.${offered ? " Your comment stands under “Said before”." : ""}`);
  }

  async function save() {
    const given = panel.given();
    const all = panel.all();
    await change("save", given);
    say(`Saved: ${points(all)} of ${points(proof.points)} points.`);
  }

  async function takeBack() {
    await change("take-back", {});
    say("Back among those to be marked.");
  }

  async function saved() {
    while (panel.isTouched()) await save(); // also what was typed while it saved
  }

  async function next() {
    await saved();
    const later = [...proof.papers.slice(at + 1), ...proof.papers.slice(0, at)];
    const one = later.find(isLeft) ?? proof.papers[at + 1];
    if (one) await go(one);
    else say("This was the last one; all are marked.");
  }

  async function previous() {
    await saved();
    if (at) await go(proof.papers[at - 1]);
    else say("This is the first one.");
  }

  function toggleModel() {
    showsModel = !showsModel;
    sessionStorage.setItem("model", showsModel ? "shown" : "hidden");
    desk.classList.toggle("without-model", !showsModel || !proof.model);
  }

  const desk = element("div", { className: "desk" }, read, model, panel.shown);
  desk.classList.toggle("without-model", !showsModel || !proof.model);
  told();
  page.replaceChildren(where, heading, fold("What was asked", proof.task), desk);
  panel.saved(answer, panel.changes());
  window.scrollTo(0, 0);
  leave = saved;
  keys = { n: next, p: previous, s: save, m: toggleModel, c: panel.toComment, 0: panel.none };
  proof.rows.slice(0, 9).forEach((_, row) => { keys[row + 1] = () => panel.toggle(row); });
  window.onbeforeunload = (event) => { if (panel.isTouched()) event.preventDefault(); };
}

async function apart(assignment, cell) {
  const found = await get("differences", { assignment, cell });
  const differ = found.papers.filter((one) => one.first !== one.second);
  const open = differ.filter((one) => one.counts === null).length;
  const choose = (one, which, total) => safely(async () => {
    try {
      await act("choose", { assignment, cell, id: one.id, version: one.version, which, total });
    } catch (error) {
      const again = async () => { await apart(assignment, cell); say(""); };
      throw error.hasChanged ? Object.assign(error, { way: ["Show all again", again] }) : error;
    }
    await apart(assignment, cell);
    say(`Answer ${one.number}: chosen.`);
  });
  const rows = found.papers.map((one) => {
    const other = field({ "aria-label": `Other points for answer ${one.number}` });
    const same = one.first === one.second;
    const choice = [
      element("button", { on: { click: choose(one, "first") } }, `first: ${points(one.first)}`), " ",
      element("button", { on: { click: choose(one, "second") } }, `second: ${points(one.second)}`), " ", other, " ",
      element("button", { on: { click: () => choose(one, "other", typed(other))() } }, "these")];
    return element("tr", {},
      element("th", { scope: "row" }, link(`mark/${path(assignment, cell, one.id)}`, one.student || `answer ${one.number}`)),
      element("td", { className: "number" }, points(one.first)), element("td", { className: "number" }, points(one.second)),
      element("td", { className: "number apart" }, same ? "" : points(one.second - one.first)),
      element("td", {}, one.rows.join(", "), one.changed ? " (the answer has changed between the two)" : ""),
      element("td", {}, one.comment),
      element("td", { className: "number" }, one.counts === null ? "" : points(one.counts)),
      element("td", { className: "choice" }, ...(same ? ["the same"] : choice)));
  });
  const heads = ["", "first", "second", "difference", "rows that differ", "second's comment", "chosen", "what counts"];
  const head = element("tr", {}, ...heads.map((text) => element("th", { scope: "col" }, text)));
  document.title = `Two markers · ${assignment}`;
  page.replaceChildren(element("p", { className: "where" }, link("", "All answers"), ` · ${assignment}`),
    element("h1", { html: found.title }),
    found.papers.length
      ? element("p", {}, `Two people have marked ${found.papers.length} answers, and differ on ${differ.length}; `,
        element("strong", {}, `${open} to decide`), ". Until you choose, the first one's points count.")
      : element("p", {}, "Nobody has marked an answer a second time. To do so, a second marker runs “autograder mark --second”."),
    element("div", { className: "wide" }, element("table", {}, element("thead", {}, head), element("tbody", {}, ...rows))));
}

async function show() {
  const [view, assignment, cell, id] = location.hash.slice(1).split("/").map(decodeURIComponent);
  try {
    if (leave) await leave();
  } catch (error) { // what is not saved stays in view
    history.replaceState(null, "", shown);
    throw error;
  }
  shown = location.hash;
  leave = keys = window.onbeforeunload = null;
  page.inert = true; // what is typed into a page that goes would be lost
  try {
    if (view === "mark" && cell) await marking(assignment, cell, id);
    else if (view === "apart" && cell) await apart(assignment, cell);
    else await list();
  } finally {
    page.inert = false;
  }
}

window.addEventListener("hashchange", async () => {
  say("");
  await safely(show)();
  arrived();
});
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const types = event.target.matches("textarea, input:not([type=checkbox])");
  if (types && event.key === "Escape") event.target.blur();
  const does = !types && keys?.[event.key];
  if (!does) return;
  event.preventDefault();
  alone(does)();
});
safely(show)();
