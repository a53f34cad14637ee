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

export const points = (number) => `${Math.round(number * 100) / 100}`;
