// Parts of a page, and points as people write them.
export function element(tag, settings = {}, ...children) {
  const made = document.createElement(tag);
  const { html, on, ...rest } = settings;
  Object.entries(rest).forEach(([name, value]) => {
    if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  });
  Object.entries(on ?? {}).forEach(([name, does]) => made.addEventListener(name, does));
  if (html !== undefined) made.innerHTML = html;
  made.append(...children);
  return made;
}

export const points = (number) => (Number.isFinite(number) ? `${Math.round(number * 100) / 100}` : "–");

// For points. Of a field of the type "number", an English browser drops the comma: 0,5 would become 5.
export const field = (settings) => element("input", { type: "text", inputMode: "decimal", autocomplete: "off", ...settings });

// The number in it; null where it is empty, and as text what is none, which the server refuses.
export function typed(input) {
  const text = input.value.trim().replace(",", ".");
  return text === "" ? null : Number.isFinite(Number(text)) ? Number(text) : text;
}
