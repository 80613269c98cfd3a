// Marks the section that is being read in the list of contents; folds the list where it is in the way.
const entries = new Map([...document.querySelectorAll("nav a")].map((a) => [a.hash.slice(1), a]));
const list = document.querySelector("nav details");
const wide = matchMedia("(min-width: 72rem)");
const fold = () => { list.open = wide.matches; };
wide.addEventListener("change", fold);
fold();
list.addEventListener("click", (event) => { if (event.target.closest("a")) fold(); });
const headings = [...document.querySelectorAll("main section[id]")];
const mark = () => {
  const passed = headings.filter((s) => s.getBoundingClientRect().top < innerHeight / 3);
  const current = passed.length ? passed[passed.length - 1].id : "";
  for (const [id, a] of entries) {
    if (id === current) a.setAttribute("aria-current", "location");
    else a.removeAttribute("aria-current");
  }
};
addEventListener("scroll", mark, { passive: true });
mark();
