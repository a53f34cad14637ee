// A dark page is printed as the light one: its letters are too pale for white paper.
let onScreen;
addEventListener("beforeprint", () => {
  const page = document.documentElement.dataset;
  onScreen = page.theme;
  page.theme = "light";
});
addEventListener("afterprint", () => {
  document.documentElement.dataset.theme = onScreen;
});
