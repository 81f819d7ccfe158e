// Starts `dotpose watch` with a web page.
import { spawn } from "node:child_process";
import { kTool } from "./browser.mjs";

/**
 * Starts `dotpose watch` with the source and additional options. Returns the address of the page, the standard input of
 * the program, and a function that ends the program.
 */
export async function watchSource(source, options = [], address = "0") {
    const always = ["--web", address, "--no-window", "-o", "/dev/null"];
    const program = spawn(kTool, ["watch", ...source, ...always, ...options], { stdio: ["pipe", "ignore", "pipe"] });
    const ended = new Promise((resolve) => program.on("exit", resolve));
    program.stdin.on("error", () => undefined); // the program may end before its input
    let messages = "";
    const url = await new Promise((resolve, reject) => {
        program.stderr.on("data", (data) => {
            messages += data;
            const found = /the page is at (\S+)/.exec(messages);
            if (found) resolve(found[1]);
        });
        program.on("exit", () => reject(new Error(messages)));
    });
    const stop = async () => {
        program.kill("SIGINT");
        await ended;
    };
    return { url, input: program.stdin, stop };
}
